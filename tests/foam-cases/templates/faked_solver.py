"""A case from the templates whose solver is faked, as the tests of what drives the solvers share it."""

import os
import subprocess
import tempfile
import unittest

TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "foam-cases", "templates")


class FakedSolverTest(unittest.TestCase):
    """Beside its case, a folder first on PATH holds the program SOLVER_NAME with the text SOLVER."""

    def make_case(self, name):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.case = os.path.join(temporary.name, name)
        programs = os.path.join(temporary.name, "bin")
        os.makedirs(programs)
        self.write(os.path.join(programs, self.SOLVER_NAME), self.SOLVER)
        os.chmod(os.path.join(programs, self.SOLVER_NAME), 0o755)
        self.path = programs + ":" + os.environ["PATH"]

    def write(self, name, text):
        with open(os.path.join(self.case, name), "w") as file:
            file.write(text)

    def run_faked(self, program, fake):
        """Returns the exit status and output of a run of the case's program; the solver gets the setting FAKE."""
        path = os.path.join(self.case, program)
        result = subprocess.run([path], env={**os.environ, "PATH": self.path, "FAKE": fake}, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, check=False, timeout=60)
        return result.returncode, result.stdout
