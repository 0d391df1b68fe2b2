// A file that the browser saves.

export function download(blob: Blob, name: string): void {
    const url = URL.createObjectURL(blob),
        anchor = document.createElement("a");
    anchor.href = url;
    anchor.download = name;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
