"""The viewer for other computers, as its user meets it: TLS with a certificate whose fingerprint is printed, files of one's
own, users with three rights and their end, and what --insecure leaves out."""
import base64
import contextlib
import hashlib
import http.client
import json
import os
import re
import signal
import socket
import ssl
import stat
import subprocess
import unittest
import urllib.error
import urllib.request

from running import FOLDER, ROBOSS, roboss

WORLD = """<sdf version="1.9"><world name="one"><model name="ball"><pose>0 0 1 0 0 0</pose><link name="l">
<inertial><mass>1</mass></inertial><collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link></model></world></sdf>"""
PATIENCE_S = 30
ONE = FOLDER / "one.sdf"
ONE.write_text(WORLD)


class Served:
    """A run that rests, with a page."""

    def __init__(self, *options):
        self.process = subprocess.Popen([ROBOSS, "run", ONE, "--paused", *map(str, options)], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE, text=True)
        self.said = ""
        self.url = self.hears(r"viewer at (\S+?)[;\s]")
        self.scheme, self.port = re.match(r"(https?)://[^/]+:(\d+)/", self.url).groups()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGINT)
        self.process.communicate(timeout=PATIENCE_S)

    def hears(self, words):
        """Reads on until the run has said this; the answer: the first group."""
        while not (found := re.search(words, self.said)):
            line = self.process.stderr.readline()
            if not line:
                raise AssertionError(f"{words} was not said:\n{self.said}")
            self.said += line
        return found.group(1) if found.groups() else found.group()

    def fingerprint(self):
        return self.hears(r"fingerprint\n  ([0-9A-F:]+)\n")

    def certificate(self):
        """As it is shown, PEM. Its fingerprint must be the printed one."""
        pem = ssl.get_server_certificate(("127.0.0.1", int(self.port)))
        digest = hashlib.sha256(ssl.PEM_cert_to_DER_cert(pem)).hexdigest().upper()
        if ":".join(digest[i:i + 2] for i in range(0, 64, 2)) != self.fingerprint():
            raise AssertionError(f"{digest} is not {self.fingerprint()}")
        return pem

    def tokens(self):
        """By role, from the private file."""
        file = self.hears(r"tokens are in (\S+)")
        with open(file, encoding="utf-8") as lines:
            found = re.findall(r"viewer (at|to watch:|to steer:) \S+\?token=([0-9a-f]{32})", lines.read())
        return {word.removeprefix("to ").rstrip(":"): token for word, token in found}


class Page:
    """A browser that trusts one certificate: requests, and a WebSocket."""

    def __init__(self, run, token="", pem=None):
        self.port, self.token = int(run.port), token
        self.context = ssl.create_default_context(cadata=pem or run.certificate())

    def get(self, path):
        """(status, headers, text)"""
        connection = http.client.HTTPSConnection("127.0.0.1", self.port, context=self.context, timeout=PATIENCE_S)
        with contextlib.closing(connection):
            connection.request("GET", path + (f"?token={self.token}" if self.token else ""))
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read().decode()

    @contextlib.contextmanager
    def socket(self):
        plain = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S)
        with self.context.wrap_socket(plain, server_hostname="127.0.0.1") as way:
            here, key = f"127.0.0.1:{self.port}", base64.b64encode(os.urandom(16)).decode()
            way.sendall(f"GET /ws?token={self.token} HTTP/1.1\r\nHost: {here}\r\nOrigin: https://{here}\r\nUpgrade: websocket\r\n"
                        f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n"
                        "Sec-WebSocket-Protocol: roboss.1\r\n\r\n".encode())
            head = b""
            while b"\r\n\r\n" not in head:
                head += way.recv(1)
            if b" 101 " not in head:
                raise AssertionError(head.decode())
            yield way

    @staticmethod
    def need(way, count):
        data = b""
        while len(data) < count:
            more = way.recv(count - len(data))
            if not more:
                raise EOFError
            data += more
        return data

    def message(self, way):
        """(kind, bytes) of the next one."""
        kind, size = self.need(way, 2)
        size &= 127
        if size > 125:
            size = int.from_bytes(self.need(way, 2 if size == 126 else 8), "big")
        return kind & 15, self.need(way, size)

    def says(self, way, number, *words):
        text, mask = json.dumps({"type": "control", "id": number, "words": words}).encode(), os.urandom(4)
        way.sendall(bytes([0x81, 0x80 | len(text)]) + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(text)))

    def asks(self, way, number, *words):
        """The text of the answer, or the code of its error."""
        self.says(way, number, *words)
        while True:
            kind, data = self.message(way)
            if kind == 1 and (said := json.loads(data))["type"] == "answer" and said["id"] == number:
                return said["text"] if said["done"] else said["code"]

    def end(self, way):
        """Why the gateway closes the socket."""
        while True:
            kind, data = self.message(way)
            if kind == 8:
                return data[2:].decode()


class OverTls(unittest.TestCase):
    def test_a_page_for_other_computers_is_encrypted_by_a_certificate_whose_fingerprint_is_printed(self):
        with Served("--view", "0.0.0.0:0") as run:
            self.assertEqual(run.scheme, "https")
            token = run.tokens()["at"]
            page = Page(run, token)
            status, headers, text = page.get("/")
            self.assertEqual(status, 200)
            self.assertIn("<!doctype html>", text.lower())
            self.assertIn("; Secure", headers["Set-Cookie"])
            self.assertEqual(json.loads(page.get("/scene")[2])["world"], "one")
            self.assertEqual(Page(run).get("/")[0], 403)
            with page.socket() as way:
                self.assertNotEqual(page.asks(way, 1, "pause"), "not-permitted")

    def test_a_browser_that_does_not_know_the_certificate_refuses_it(self):
        with Served("--view", "0.0.0.0:0") as run, self.assertRaises(urllib.error.URLError) as refused:
            urllib.request.urlopen(f"https://127.0.0.1:{run.port}/", timeout=PATIENCE_S)
        self.assertIsInstance(refused.exception.reason, ssl.SSLCertVerificationError)

    def test_a_plain_caller_is_led_to_tls(self):
        with Served("--view", "0.0.0.0:0") as run:
            connection = http.client.HTTPConnection("127.0.0.1", int(run.port), timeout=PATIENCE_S)
            with contextlib.closing(connection):
                connection.request("GET", "/scene")
                answer = connection.getresponse()
                self.assertEqual((answer.status, answer.getheader("Location")), (307, f"https://127.0.0.1:{run.port}/scene"))
                self.assertNotIn("ball", answer.read().decode())

    def test_insecure_serves_it_plain_with_tokens_and_loopback_is_plain(self):
        with Served("--view", "0.0.0.0:0", "--insecure") as run:
            self.assertEqual(run.scheme, "http")
            run.hears("not encrypted")
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(f"http://127.0.0.1:{run.port}/", timeout=PATIENCE_S)
            self.assertEqual(refused.exception.code, 403)
        with Served("--view", "0") as run:
            with urllib.request.urlopen(run.url, timeout=PATIENCE_S) as answer:
                self.assertEqual(answer.status, 200)
            self.assertNotIn("fingerprint", run.said)

    def test_a_certificate_of_files_is_shown_and_wrong_files_are_refused(self):
        keys = FOLDER / "page_keys"
        self.assertEqual(roboss("keys", "add", keys, "page", "--role", "controller").returncode, 0)
        files = ["--view-cert", keys / "page/member.crt", "--view-key", keys / "page/member.key"]
        with Served("--view", "0", *files) as run:
            self.assertEqual(run.scheme, "https")
            self.assertEqual(run.certificate(), (keys / "page/member.crt").read_text())
        (keys / "page/member.key").chmod(0o644)
        for wrong, code in ((files, "open-key"), (["--view-cert", keys / "authority.crt", "--view-key", keys / "authority.crt"],
                                                  "bad-certificate")):
            done = roboss("run", ONE, "--view", 0, "--duration", 0.01, *wrong)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(f"[{code}]", done.stderr)


class Users(unittest.TestCase):
    def test_three_rights_and_the_end_of_one(self):
        keys = FOLDER / "users_keys"
        token = {}
        for name, role in (("ann", "watch"), ("ben", "steer"), ("cy", "administer")):
            added = roboss("keys", "add", keys, name, "--role", role)
            self.assertRegex(added.stdout, r"^[0-9a-f]{32}\n$", added.stderr)
            token[name] = added.stdout.strip()
        users = keys / "users"
        self.assertEqual(stat.S_IMODE(users.stat().st_mode), 0o600)
        for word in token.values():
            self.assertNotIn(word, users.read_text())
        self.assertIn("[key-exists]", roboss("keys", "add", keys, "ann", "--role", "steer").stderr)
        self.assertRegex(roboss("keys", "list", keys).stdout, r"ben +steer")
        self.assertIn("[key-exists]", roboss("keys", "add", keys, "ann", "--role", "client").stderr)
        self.assertIn("[bad-name]", roboss("keys", "add", keys, "users", "--role", "client").stderr)
        with Served("--view", "0.0.0.0:0", "--view-users", users, "--log", "-") as run:
            self.assertNotIn("token=", run.url)
            self.assertEqual(Page(run).get("/")[0], 403)
            pages = {name: Page(run, token[name]) for name in token}
            with pages["ann"].socket() as way:
                self.assertEqual(pages["ann"].asks(way, 1, "pause"), "not-permitted")
            with pages["ben"].socket() as way:
                self.assertNotEqual(pages["ben"].asks(way, 1, "pause"), "not-permitted")
                self.assertEqual(pages["ben"].asks(way, 2, "save", "x.roboss"), "not-permitted")
                self.assertEqual(roboss("keys", "revoke", keys, "ben").returncode, 0)
                self.assertEqual(pages["ben"].end(way), "revoked: the token of ben was revoked")
            run.hears(r"ben at 127\.0\.0\.1: the token of ben was revoked \[revoked\]")
            status, _, text = pages["ben"].get("/")
            self.assertEqual(status, 403)
            self.assertIn("the token of ben was revoked", text)
            with pages["cy"].socket() as way:
                self.assertIn("10 ticks", pages["cy"].asks(way, 1, "window", "10"))
                pages["cy"].says(way, 2, "quit")
                pages["cy"].end(way)
            self.assertEqual(run.process.wait(PATIENCE_S), 0)
            run.said += run.process.stderr.read()
            for word in token.values():
                self.assertNotIn(word, run.said)

    def test_a_file_that_others_may_read_or_with_a_wrong_line_is_refused(self):
        users = FOLDER / "users"
        users.write_text("ann watch " + "0" * 64 + "\n")
        for text, mode, code in ((users.read_text(), 0o644, "open-key"), ("ann owner " + "0" * 64, 0o600, "bad-users"),
                                 ("ann watch secret", 0o600, "bad-users"), ("../ann watch " + "0" * 64, 0o600, "bad-users")):
            users.write_text(text)
            users.chmod(mode)
            done = roboss("run", ONE, "--view", 0, "--duration", 0.01, "--view-users", users)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(f"[{code}]", done.stderr)


if __name__ == "__main__":
    unittest.main()
