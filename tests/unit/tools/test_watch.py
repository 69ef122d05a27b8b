"""The server of a watched run: events of a growing results folder, the stop button, who is refused, readers that do not
read, and its end."""

import contextlib
import http.client
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
import urllib.parse

from launch_case import Launch
from toryu import PROGRAMS
from toryu.installation import ROOT
from toryu.watch import feed, server
from toryu_testing import made_up_run

HEADER = "# made up\ntime[s],mass[kg]\n"


class Events:
    """The events of a response, one after the other."""

    def __init__(self, port, path, **headers):
        self.connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
        self.connection.request("GET", path, headers=headers)
        self.response = self.connection.getresponse()

    def next(self, kind):
        """Content and id of the next event of a kind."""
        found = {}
        while line := self.response.readline().decode():
            name, _, text = line.rstrip("\n").partition(": ")
            if name:
                found[name] = text
            elif found.get("event") == kind:
                return json.loads(found["data"]), found["id"]
        raise EOFError(kind)

    def take_all(self, page):
        """Waits for the end; returns the last page."""
        self.next("end")
        connection = http.client.HTTPConnection("127.0.0.1", self.connection.port, timeout=20)
        connection.request("GET", page)
        with contextlib.closing(connection):
            return connection.getresponse().read().decode()

    def close(self):
        self.response.close()
        self.connection.close()


class Watch(unittest.TestCase):
    def setUp(self):
        self.enterContext(unittest.mock.patch.multiple(server, PAUSE=0.02, PATIENCE=1.0))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)
        self.told = feed.Feed(self.out, str(self.out / "no_case.toml"), PROGRAMS / "coupler")
        self.server = server.Server(0, self.told, lambda: "the page")
        self.thread = threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
        self.thread.start()
        self.addCleanup(self.end)
        self.base = urllib.parse.urlsplit(self.server.address).path

    def end(self):
        self.server.opening.clear()  # nobody takes the last page
        if not self.server.over.is_set():
            self.server.end()

    def events(self, **headers):
        events = Events(self.server.server_port, self.base + "events", **headers)
        self.addCleanup(events.close)
        return events

    def add(self, text, name="fluid"):
        with open(self.out / f"{name}.csv", "a") as file:
            file.write(text)

    def ask(self, path, method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.server.server_port, timeout=20)
        self.addCleanup(connection.close)
        connection.request(method, path, headers={name.replace("_", "-"): value for name, value in headers.items()})
        answer = connection.getresponse()
        return answer.status, answer.read().decode()

    def test_only_new_and_whole_rows_are_sent(self):
        self.add(HEADER + "0.1,1\n0.2,na")
        events = self.events()
        self.assertEqual(events.next("rows")[0], {"name": "fluid", "columns": ["time[s]", "mass[kg]"], "rows": [[0.1, 1.0]]})
        self.add("n\n0.3,3\n")
        content, reached = events.next("rows")
        self.assertEqual(content["rows"], [[0.2, None], [0.3, 3.0]])
        self.add("0.4,4\n")
        # one that was cut off goes on where it was
        again = self.events(**{"Last-Event-ID": reached})
        self.assertEqual(again.next("rows")[0]["rows"], [[0.4, 4.0]])

    def test_a_file_that_gets_its_final_name_goes_on(self):
        (self.out / "fluid.csv.part").write_text(HEADER + "0.1,1\n")
        events = self.events()
        events.next("rows")
        (self.out / "fluid.csv.part").rename(self.out / "fluid.csv")
        self.add("0.2,2\n")
        self.assertEqual(events.next("rows")[0]["rows"], [[0.2, 2.0]])

    def test_the_newest_frame_is_sent(self):
        made_up_run.write_frames(self.out, "fluid", made_up_run.fluid, [0.0])
        events = self.events()
        self.assertEqual(events.next("frame")[0]["bodies"][0]["times"], [0.0])
        made_up_run.write_frames(self.out, "fluid", made_up_run.fluid, [0.0, 0.1, 0.2])
        body, = events.next("frame")[0]["bodies"]
        self.assertEqual((body["times"], len(body["frames"])), ([0.2], 1))

    def test_warnings_are_sent_once(self):
        (self.out / "log.txt").write_text("12:00 0.1 fluid warning: fast\n12:00 0.2 fluid warning: fast\n")
        self.assertEqual(self.events().next("warnings")[0], ["fluid warning: fast"])

    def test_how_far_the_run_is(self):
        self.assertEqual(self.told.progress(), "no results yet")
        self.add(HEADER)
        self.assertEqual(self.told.progress(), "no results yet")
        self.add("0.0,1\n0.1,1\n0.2,")
        (self.out / "used_case.toml").write_text("[case]\nend_time = 0.4\n[fluid]\n")
        self.assertEqual(self.told.progress(), "0.1 of 0.4 s simulated (25 %)")
        self.told.first = (0.0, time.monotonic() - 100)  # 0.1 s in 100 s
        self.add("time[s],mass[kg]\n0.2,1\n", "solid")
        self.assertEqual(self.told.progress(), "0.1 of 0.4 s simulated (25 %), 5 min 0 s left")

    def test_stop(self):
        own = f"http://127.0.0.1:{self.server.server_port}"
        self.assertEqual(self.ask(self.base + "stop", "POST", X_Toryu="stop", Origin=own)[0], 204)
        self.assertTrue((self.out / "stop").exists())

    def test_others_may_not_stop_nor_read(self):
        port = self.server.server_port
        self.assertEqual(self.ask(self.base, Host=f"127.0.0.1:{port}"), (200, "the page"))
        for path, method, headers in (
                ("/", "GET", {}), ("/wrong/", "GET", {}), (self.base[:-2] + "/", "GET", {}),
                (self.base, "GET", {"Host": f"elsewhere.example:{port}"}),  # a name that leads here
                (self.base, "GET", {"Origin": "http://elsewhere.example"}),
                (self.base + "stop", "POST", {}),
                (self.base + "stop", "POST", {"X_Toryu": "stop", "Origin": "null"}),
                (self.base + "stop", "POST", {"X_Toryu": "stop", "Origin": f"http://127.0.0.1:{port + 1}"}),
                ("/wrong/stop", "POST", {"X_Toryu": "stop"})):
            with self.subTest(path=path, method=method, **headers):
                self.assertEqual(self.ask(path, method, **headers), (403, ""))
        self.assertFalse((self.out / "stop").exists())

    def test_no_file_is_served(self):
        (self.out / "secret").write_text("a secret")
        for path in ("secret", "../secret", "%2e%2e/secret", "./secret", "..%2fsecret", f"/{self.out}/secret", "\\secret"):
            with self.subTest(path=path):
                status, text = self.ask(self.base + path)
                self.assertIn(status, (403, 404))
                self.assertNotIn("secret", text)

    def test_one_who_does_not_read_holds_up_nobody(self):
        self.add(HEADER)
        with socket.create_connection(("127.0.0.1", self.server.server_port)) as deaf:
            deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            deaf.sendall(f"GET {self.base}events HTTP/1.0\r\nHost: 127.0.0.1:{self.server.server_port}\r\n\r\n".encode())
            events, count = self.events(), 0
            start = time.monotonic()
            self.add("".join(f"{k / 1e4},{'1' * 60}\n" for k in range(1_000 * 100)))
            while count < 100_000:
                count += len(events.next("rows")[0]["rows"])
            self.assertLess(time.monotonic() - start, 10)
            limit = time.monotonic() + 20
            while self.server.streams > 1 and time.monotonic() < limit:
                time.sleep(0.05)
            self.assertEqual(self.server.streams, 1)

    def test_so_many_and_no_more(self):
        all_streams = [self.events() for _ in range(server.MOST_STREAMS)]
        self.assertEqual({events.response.status for events in all_streams}, {200})
        self.assertEqual(self.events().response.status, 503)

    def test_the_end_reaches_those_who_watch(self):
        self.add(HEADER)
        events = self.events()
        events.next("progress")
        self.add("0.1,1\n")
        ending = threading.Thread(target=self.server.end)
        ending.start()
        self.assertEqual(events.next("rows")[0]["rows"], [[0.1, 1.0]])
        events.next("end")
        self.assertEqual(self.ask(self.base)[1], "the page")  # the last one
        ending.join(2)
        self.assertFalse(ending.is_alive())
        with self.assertRaises(ConnectionRefusedError):
            self.ask(self.base)

    def test_the_end_reaches_a_page_that_is_being_opened(self):
        self.ask(self.base)
        ending = threading.Thread(target=self.server.end)
        ending.start()
        self.server.over.wait(2)
        time.sleep(0.2)
        events = self.events()
        events.next("end")
        self.ask(self.base)
        ending.join(0.5)
        self.assertFalse(ending.is_alive())


class Launched(Launch):
    def start(self, *options):
        process = subprocess.Popen(self.command("--watch", *options), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                   cwd=self.folder)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process, urllib.parse.urlsplit(process.stdout.readline().split()[1])

    def assert_closed(self, url):
        def closed():
            with contextlib.suppress(ConnectionRefusedError):
                socket.create_connection((url.hostname, url.port)).close()
                return False
            return True
        self.wait_for(closed)

    def test_it_ends_with_the_run(self):
        self.plan("wait 0.3", "wait 0.3", "wait 0.3")
        process, url = self.start("--no-report")
        events = Events(url.port, url.path + "events")
        self.addCleanup(events.close)
        self.assertIn('<span class="badge good">Done</span>', events.take_all(url.path))
        self.assertEqual(process.wait(20), 0)
        self.assert_closed(url)

    def test_a_run_of_somebody_else(self):
        self.plan("wait 60", "wait 60", "wait 60")
        run = subprocess.Popen(self.command(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder)
        self.addCleanup(run.wait)
        self.addCleanup(run.terminate)
        self.wait_for(lambda: feed.of_running(self.out))
        watcher = subprocess.Popen([*self.command()[:3], "--watch", str(self.out)], stdout=subprocess.PIPE, text=True)
        self.addCleanup(watcher.stdout.close)
        self.addCleanup(watcher.wait)
        self.addCleanup(watcher.kill)
        url = urllib.parse.urlsplit(watcher.stdout.readline().split()[1])
        events = Events(url.port, url.path + "events")
        self.addCleanup(events.close)
        events.next("progress")
        run.terminate()
        self.assertIn('<span class="badge', events.take_all(url.path))
        self.assertEqual(watcher.wait(20), 0)

    def test_it_dies_with_a_killed_launcher(self):
        self.plan("wait 60", "wait 60", "wait 60")
        process, url = self.start()
        os.kill(process.pid, signal.SIGKILL)
        self.assert_closed(url)

    def test_a_port_that_is_taken(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            done = self.launch("--watch", str(taken.getsockname()[1]))
        self.assertEqual(done.returncode, 5)
        self.assertIn("Address already in use", done.stderr)

    def test_what_is_no_port(self):
        for text in ("0", "65536", "port"):
            done = self.launch("--watch", text)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"--watch {text}: error: is no port: from 1 to 65535", done.stderr)

    def test_a_folder_without_a_run(self):
        done = subprocess.run([*self.command()[:3], "--watch", str(self.out)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no run writes its results there", done.stderr)


class SameResults(unittest.TestCase):
    def test_who_watches_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            outs = [pathlib.Path(folder) / name for name in ("alone", "watched")]
            for out in outs:
                with subprocess.Popen([sys.executable, "-m", "toryu.launch", str(ROOT / "cases/dam_break"), f"--out={out}",
                                       "--end-time=0.02", "--threads=1", "--no-report",
                                       *(["--watch"] if out.name == "watched" else [])],
                                      stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as run:
                    if out.name == "watched":
                        url = urllib.parse.urlsplit(run.stdout.readline().split()[1])
                        events = Events(url.port, url.path + "events")
                        self.addCleanup(events.close)
                        self.assertTrue(events.next("rows")[0]["rows"])
                        self.assertIn('<span class="badge good">Done</span>', events.take_all(url.path))
                    run.stdout.read()
                self.assertEqual(run.returncode, 0)
            files = [sorted(path.relative_to(out) for path in out.rglob("*") if path.suffix in (".csv", ".hdf")) for out in outs]
            self.assertGreater(len(files[0]), 1)
            self.assertEqual(*files)
            for file in files[0]:
                self.assertEqual((outs[0] / file).read_bytes(), (outs[1] / file).read_bytes(), file)


if __name__ == "__main__":
    unittest.main()
