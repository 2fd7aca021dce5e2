"""The `welkin` command as a process beside Blender: nothing of Blender is needed here."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import threading

_PERCENT = re.compile(r"(\d+) %  ")  # of a line of progress


class WelkinError(Exception):
    """What the command said, or why it could not be run."""


def find(preferred=""):
    """The program: the path preferred, $WELKIN, or `welkin` on the PATH. Raises WelkinError."""
    for path in (preferred, os.environ.get("WELKIN", "")):
        if path:
            if os.path.isfile(path) and os.access(path, os.X_OK):
                return path
            raise WelkinError(f"{path} is not a program: name the `welkin` command in the add-on's preferences")
    path = shutil.which("welkin")
    if not path:
        raise WelkinError("the `welkin` command was not found: name it in the add-on's preferences")
    return path


class Cancelled(WelkinError):
    """The user has ended it."""


class Job:
    """A running command; its progress is a share of 1. Ended by cancel() or by itself."""

    def __init__(self, program, arguments, folder=None):
        self.progress = 0.0
        self._folder = folder
        self._cancelled = False
        self._said = []
        try:
            self._process = subprocess.Popen([program, *map(str, arguments)], stdin=subprocess.DEVNULL,
                                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                             encoding="utf-8", errors="replace")
        except OSError as error:
            raise WelkinError(f"{program}: {error.strerror}") from None
        self._out = []
        self._readers = [threading.Thread(target=self._listen, daemon=True),
                         threading.Thread(target=lambda: self._out.append(self._process.stdout.read()), daemon=True)]
        for reader in self._readers:
            reader.start()

    def _listen(self):
        for line in self._process.stderr:
            found = None if line.startswith("welkin:") else _PERCENT.search(line)
            if found:
                self.progress = min(int(found[1]), 100) / 100
            elif line.strip():
                self._said.append(line.strip())

    def running(self):
        return self._process.poll() is None

    def cancel(self):
        """Ends the command and removes what it had half written."""
        self._cancelled = True
        if self.running():
            self._process.terminate()
            try:
                self._process.wait(5)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        if self._folder:
            for part in pathlib.Path(self._folder).glob(f".*.{self._process.pid}.*.part"):
                part.unlink(missing_ok=True)

    def result(self):
        """Waits for the end; what the command printed. Raises WelkinError with its message."""
        code = self._process.wait()
        for reader, pipe in zip(self._readers, (self._process.stderr, self._process.stdout)):
            reader.join()
            pipe.close()
        if self._cancelled:
            raise Cancelled("cancelled")
        if code != 0:
            said = [line.removeprefix("welkin: ") for line in self._said]
            raise WelkinError("; ".join(said[-2:]) if said else f"welkin ended with code {code}")
        return self._out[0]


def ask(program, *arguments):
    """What a short command prints. Raises WelkinError."""
    return Job(program, arguments).result()


def presets(program):
    """The skies that come with Welkin: dictionaries of name, genus, sentence and file."""
    return json.loads(ask(program, "presets", "--json"))


def values(program, sky):
    """Every parameter of a sky, a preset or a file: the rows of `welkin fields SKY --json`."""
    return json.loads(ask(program, "fields", sky, "--json"))
