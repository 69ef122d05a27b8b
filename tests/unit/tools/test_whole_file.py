"""Files that are there in full or not at all, also after a power cut."""
import os
import pathlib
import tempfile
import unittest
from unittest import mock

from toryu.program import whole_file, write_whole


class WholeFile(unittest.TestCase):
    def setUp(self):
        self.path = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "a.csv"

    def test_its_content_is_on_the_disk_before_it_has_its_name(self):
        with mock.patch("os.fsync") as synchronise, mock.patch("os.replace") as rename:
            synchronise.side_effect = lambda file: self.assertEqual(os.fstat(file).st_size, 5)
            rename.side_effect = lambda *_: synchronise.assert_called_once()
            write_whole(self.path, "a,b\r\n")
        rename.assert_called_once()

    def test_what_was_there_stays_if_writing_fails(self):
        write_whole(self.path, "before")
        with self.assertRaises(ValueError), whole_file(self.path) as file:
            file.write("half")
            raise ValueError
        self.assertEqual(self.path.read_text(), "before")

    def test_a_failure_names_the_file(self):
        with mock.patch("os.fsync", side_effect=OSError(5, "Input/output error")):
            with self.assertRaises(OSError) as caught:
                write_whole(self.path, "a")
        self.assertEqual(caught.exception.filename, str(self.path) + ".part")
        self.assertFalse(self.path.exists())


if __name__ == "__main__":
    unittest.main()
