"""The exceptions of the package. All derive from RobossError, and from ValueError or RuntimeError."""


class RobossError(Exception):
    """Something that RoBOSS refuses, or that failed.

    Attributes:
        message: what is wrong, with the names of robots, joints, sensors.
        remedy: what to do about it; may be empty.
        code: names the kind of error for programs, as "beyond-limit"; may be empty. Texts may change, codes do not.
    """

    def __init__(self, message: str, remedy: str = "", code: str = ""):
        super().__init__(message, remedy, code)
        self.message, self.remedy, self.code = message, remedy, code

    def __str__(self) -> str:
        code = f" [{self.code}]" if self.code else ""
        remedy = f"\n  remedy: {self.remedy}" if self.remedy else ""
        return self.message + code + remedy


class WorldError(RobossError, ValueError):
    """A world cannot be used. The text lists everything that is wrong, with file and line.

    Attributes:
        diagnostics: all findings about the file, as World.diagnostics.
    """

    def __init__(self, message: str, remedy: str = "", code: str = "", diagnostics: tuple = ()):
        super().__init__(message, remedy, code)
        self.diagnostics = diagnostics


class UnknownNameError(RobossError, ValueError):
    """There is no robot, link, joint, sensor or command of that name. The text lists those that exist."""


class ArgumentError(RobossError, ValueError):
    """An argument of the wrong shape, type or range."""


class OrderError(RobossError, ValueError):
    """A robot refuses an order or a new state: a number that is not finite or too large, a fixed base ..."""


class SensorError(RobossError, ValueError):
    """A sensor cannot measure."""


class SaveError(RobossError, ValueError):
    """A saved state that belongs to another world, is damaged, or cannot be written."""


class JournalError(RobossError, ValueError):
    """A journal that cannot be read, or does not have a time."""


class ViewError(RobossError, RuntimeError):
    """A view that cannot be opened: no port is free, the address cannot be used."""


class ClusterError(RobossError, RuntimeError):
    """A run on a cluster that cannot be reached, has ended, or refuses a request."""


class StateError(RobossError, RuntimeError):
    """The world cannot be stepped further, or another thread is using it."""


class WorldWarning(UserWarning):
    """A finding about a world file that is used nevertheless, with file and line."""
