"""What a run and a host tell each other: messages, files that grow and change, hosts and versions."""
import os
import pathlib
import re
import tempfile
import threading
import types
import unittest
import unittest.mock

from toryu.processes import MACHINE, PEER_LOST
from toryu.remote import agent, placement
from toryu.remote.__main__ import is_same
from toryu.remote.channel import Channel, ChannelClosed, Silence
from toryu.remote.connection import Connection, HostFailed
from toryu.remote.job import Job, argument, restart_files
from toryu.remote.mirror import Mirror, Receiver, remove


class Folders(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.there, self.here = self.base / "there", self.base / "here"
        self.there.mkdir(), self.here.mkdir()

    def write(self, name, text, root=None):
        path = (root or self.there) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def pair(self):
        """Two ends of a channel."""
        (read_a, write_b), (read_b, write_a) = os.pipe(), os.pipe()
        self.addCleanup(lambda: [os.close(end) for end in (read_a, write_a, read_b, write_b) if end not in self.closed])
        self.closed = set()
        return Channel(read_a, write_a), Channel(read_b, write_b)


class Messages(Folders):
    def test_come_whole_and_in_order_and_signs_of_life_are_passed_over(self):
        a, b = self.pair()
        large = os.urandom(1 << 20)
        sending = threading.Thread(target=lambda: [a.send("alive"), a.send("file", large, name="x\n"), a.send("ended")])
        sending.start()
        message, data = b.receive(5)
        self.assertEqual((message["kind"], message["name"], data), ("file", "x\n", large))
        self.assertEqual(b.receive(5)[0]["kind"], "ended")
        sending.join()

    def test_begin_behind_what_a_login_says(self):
        a, b = self.pair()
        os.write(a.outgoing, b'Welcome\n{"kind": "no"}\n' + agent.MARK)
        a.send("checked")
        b.skip_to(agent.MARK, 5)
        self.assertEqual(b.receive(5)[0]["kind"], "checked")

    def test_that_do_not_come_are_missed(self):
        a, b = self.pair()
        self.assertRaises(Silence, b.receive, 0.01)
        os.write(a.outgoing, b'{"kind": "log", "si')  # the rest comes later
        self.assertRaises(Silence, b.receive, 0.01)
        os.write(a.outgoing, b'ze": 2}\nab')
        self.assertEqual(b.receive(5)[1], b"ab")
        os.close(a.outgoing)
        self.closed.add(a.outgoing)
        self.assertRaises(ChannelClosed, b.receive, 5)


    def test_that_are_none_end_the_channel_with_what_was_said(self):
        for said in (b"10.0.0.2 bash", b"12", b"{}", b'{"kind": 1, "size": 0}', b'{"kind": "log", "size": "x"}', b"\xff"):
            a, b = self.pair()
            os.write(a.outgoing, said + b"\n")
            with self.assertRaisesRegex(ChannelClosed, "^it said '" + re.escape(said.decode(errors="replace")) + "'$"):
                b.receive(5)


class Packages(unittest.TestCase):
    def test_are_beside_the_programs_there(self):
        def there(remote_bin):
            return placement.packages_there(types.SimpleNamespace(remote_bin=remote_bin)).split(":")

        self.assertEqual(there(None), [str(pathlib.Path(placement.__file__).parents[2])])
        self.assertIn("/home/me/toryu/tools", there("/home/me/toryu/build/release/bin"))
        self.assertIn("/opt/toryu/lib/toryu/tools", there("/opt/toryu/bin/"))


class Hosts(Folders):
    def test_that_let_nobody_in_are_told_with_their_words(self):
        for words, end in (("echo 'This account is not available.'", "it ended: This account is not available.;"),
                           ("echo 'Welcome'; echo 'No route' >&2", "it ended: No route;"), ("true", "it ended;")):
            job = Job("fluid_solver", "10.0.0.2", ["sh", "-c", words], "fluid_solver")
            with self.assertRaises(HostFailed) as failure:
                Connection(job)
            self.assertIn(f"10.0.0.2 cannot be reached: {end}", str(failure.exception))
            self.assertEqual(failure.exception.code, MACHINE)

    def connection(self):
        """To a host that has answered once, and the host's end."""
        host, here = self.pair()
        connection = Connection.__new__(Connection)
        connection.job, connection.channel, connection.limit = types.SimpleNamespace(address="10.0.0.2"), here, 13.0
        return connection, host

    def test_that_are_silent_for_long_are_lost(self):
        connection, host = self.connection()
        self.assertEqual(connection.receive(0.01)[0]["kind"], "nothing")
        connection.channel.heard -= 14
        host.send("alive")
        self.assertEqual(connection.receive(0.01)[0]["kind"], "nothing")
        connection.channel.heard -= 14
        with self.assertRaisesRegex(HostFailed, "the connection to 10.0.0.2 is gone: no sign of life for 13 s") as lost:
            connection.receive(0.01)
        self.assertEqual(lost.exception.code, PEER_LOST)

    def test_tell_what_is_wrong_there(self):
        connection, host = self.connection()
        host.send("fault", text="/tmp: No space left on device", is_machine=True)
        with self.assertRaisesRegex(HostFailed, "^error: the machine: 10.0.0.2: /tmp: No space left on device$") as failed:
            connection.receive(5)
        self.assertEqual(failed.exception.code, MACHINE)

    def test_know_each_other_by_addresses_that_all_can_reach(self):
        names = ["coupler", "fluid_solver", "solid_solver"]
        towards = {"127.0.0.1": "127.0.0.1", "10.0.0.3": "10.0.0.1", "10.0.0.2": "10.0.0.1"}
        with unittest.mock.patch.object(placement, "own_address", towards.get):
            for hosts, peers in (({"fluid_solver": "user@10.0.0.2"}, "10.0.0.1,10.0.0.2"),
                                 ({"fluid_solver": "127.0.0.1", "solid_solver": "10.0.0.3"}, "10.0.0.1,10.0.0.3"),
                                 ({"fluid_solver": "127.0.0.1"}, "127.0.0.1"),
                                 (dict.fromkeys(names, "10.0.0.2"), "10.0.0.2")):
                self.assertEqual(placement.peers_of(hosts, names), peers)


class Copies(Folders):
    def setUp(self):
        super().setUp()
        self.sent = []  # of each message: name, first byte, bytes
        receiver = Receiver(self.here)

        def send(kind, data=b"", **content):
            if kind == "gone":
                self.sent.append((content["name"], "gone"))
                return remove(self.here, content["name"])
            self.sent.append((content["name"], content["at"], data.decode()))
            receiver.take(content, data)

        self.mirror = Mirror(self.there, types.SimpleNamespace(send=send), keeps_checkpoints=False)

    def bring(self):
        self.sent.clear()
        self.mirror.bring_up_to_date()
        return self.sent

    def test_are_sent_once(self):
        self.write("fluid.csv.part", "a,b\n")
        self.assertEqual(self.bring(), [("fluid.csv.part", 0, "a,b\n")])
        self.assertEqual(self.bring(), [])

    def test_that_grow_are_sent_from_where_they_grew(self):
        path = self.write("fluid.csv.part", "a,b\n")
        self.bring()
        with open(path, "a") as file:
            file.write("1,2\n")
        self.assertEqual(self.bring(), [("fluid.csv.part", 4, "1,2\n")])
        self.assertEqual((self.here / "fluid.csv.part").read_text(), "a,b\n1,2\n")

    def test_that_change_are_sent_whole(self):
        self.write("interface.h5", "one of five")
        self.bring()
        self.write("interface.h5", "two of fifteen")
        self.assertEqual(self.bring(), [("interface.h5", 0, "two of fifteen")])
        self.write("interface.h5", "three")
        self.bring()
        self.assertEqual((self.here / "interface.h5").read_text(), "three")

    def test_take_the_last_name_and_go_when_the_file_goes(self):
        part = self.write("fluid.csv.part", "a\n")
        self.bring()
        part.rename(self.there / "fluid.csv")
        self.assertEqual(self.bring(), [("fluid.csv", 0, "a\n"), ("fluid.csv.part", "gone")])
        self.assertEqual([path.name for path in self.here.iterdir()], ["fluid.csv"])

    def test_of_what_is_written_still_or_of_a_host_alone_are_none(self):
        for name in ("frames/fluid_000001.hdf.part", "checkpoint/000001/fluid.state.part", "run.secret", "run.lock",
                     "log.txt"):
            self.write(name, "x")
        self.assertFalse(self.mirror.has_news())
        self.assertEqual(self.bring(), [])

    def test_of_checkpoints_come_last_and_leave_room(self):
        part = self.write("checkpoint/000001/fluid.state", "state")
        self.write("fluid.csv.part", "a\n")
        self.assertTrue(self.mirror.has_news())
        self.assertEqual([name for name, *_ in self.bring()], ["fluid.csv.part", "checkpoint/000001/fluid.state"])
        self.assertFalse(part.exists())
        self.assertEqual(self.bring(), [])
        self.assertEqual((self.here / "checkpoint/000001/fluid.state").read_text(), "state")

    def test_are_wanted_at_once_when_the_run_has_begun(self):
        path = self.write("used_case.toml", "a")
        self.mirror.note(path)
        self.assertFalse(self.mirror.has_news())
        self.write("used_case.toml", "of the restart")
        self.assertTrue(self.mirror.has_news())

    def test_of_frames_leave_room(self):
        frame = self.write("frames/fluid_000001.hdf", "frame")
        self.bring()
        self.assertFalse(frame.exists())
        self.assertEqual(self.bring(), [])
        self.assertTrue((self.here / "frames/fluid_000001.hdf").exists())

    def test_that_cannot_be_written_are_passed_over(self):
        receiver = Receiver(self.here)
        self.write("file", "x", self.here)
        for at, is_last in ((0, False), (3, False), (6, True)):
            message = {"name": "file/a", "at": at, "last": is_last, "mode": 0o644}
            if at == 0:
                self.assertRaises(OSError, receiver.take, message, b"abc")
            else:
                self.assertIsNone(receiver.take(message, b"abc"))
        self.assertTrue(receiver.take({"name": "b", "at": 0, "last": True, "mode": 0o644}, b"abc"))

    def test_of_the_lead_have_the_manifest_last(self):
        self.mirror.keeps_checkpoints = True
        for name in ("manifest.toml", "coupler.state", "solid.state"):
            self.write(f"checkpoint/000001/{name}", "x")
        self.assertEqual([pathlib.Path(name).name for name, *_ in self.bring()],
                         ["coupler.state", "solid.state", "manifest.toml"])

    def test_never_leave_their_folder(self):
        for name in ("../x", "/tmp/x", "a/../../x"):
            with self.assertRaisesRegex(ValueError, "leads out of its folder"):
                Receiver(self.here).take({"name": name, "at": 0, "last": True, "mode": 0o644}, b"")
            self.assertRaises(ValueError, remove, self.here, name)

    def test_that_did_not_come_whole_have_no_name(self):
        receiver = Receiver(self.here)
        receiver.take({"name": "a", "at": 0, "last": False, "mode": 0o644}, b"half")
        self.assertFalse((self.here / "a").exists())
        receiver.give_up()
        self.assertEqual(list(self.here.iterdir()), [])

    def test_keep_secrets_to_their_owner(self):
        Receiver(self.here).take({"name": "run.secret", "at": 0, "last": True, "mode": 0o600}, b"x")
        self.assertEqual((self.here / "run.secret").stat().st_mode & 0o777, 0o600)


class Jobs(Folders):
    def test_of_one_commit_go_together(self):
        ours = "fluid_solver of toryu 0.1.0 (commit 193b580, GCC 12.2.0)"
        self.assertTrue(is_same("fluid_solver of toryu 0.1.0 (commit 193b580, Clang 14)", ours))
        for other in ("fluid_solver of toryu 0.1.0 (commit 193b580-dirty, GCC 12.2.0)", "", "Segmentation fault",
                      "fluid_solver of toryu 0.2.0 (commit 193b580, GCC 12.2.0)"):
            self.assertFalse(is_same(other, ours), other)

    def test_have_the_paths_of_here_below_their_folder(self):
        self.assertEqual(argument("/home/user/case", "/tmp/toryu_1"), "/tmp/toryu_1/home/user/case")
        self.assertEqual(argument("cases/gate", "/tmp/toryu_1"), "cases/gate")

    def test_take_what_the_case_names_but_by_absolute_paths(self):
        own, table, absolute = (self.write(name, "x") for name in ("case.toml", "table.csv", "other.csv"))
        case = types.SimpleNamespace(inputs=[own, table, absolute], files=["table.csv", str(absolute)])
        self.assertEqual(placement.inputs_of(case), [own, table])

    def test_that_go_on_take_their_own_files_and_of_frames_the_names(self):
        for name in ("fluid.csv", "solid.csv", "coupler.csv", "surface.h5.rows", "log.txt", "run.lock",
                     "frames/fluid_000000.hdf", "frames/solid_000000.hdf", *(f"checkpoint/00000{n}/{part}" for n in (1, 2)
                     for part in ("fluid.state", "solid.state", "coupler.state", "manifest.toml"))):
            self.write(name, "x", self.here)
        newest = self.here / "checkpoint/000002"

        def found(part, is_lead):
            return {path.relative_to(self.here).as_posix(): needed
                    for path, needed in restart_files(self.here, newest, part, is_lead).items()}

        self.assertEqual(found("fluid", False), {"fluid.csv": True, "surface.h5.rows": True, "frames/fluid_000000.hdf": False,
                                                 "checkpoint/000002/fluid.state": True})
        of_lead = found("coupler", True)
        self.assertEqual(len([name for name in of_lead if name.startswith("checkpoint")]), 8)
        self.assertIn("coupler.csv", of_lead)


if __name__ == "__main__":
    unittest.main()
