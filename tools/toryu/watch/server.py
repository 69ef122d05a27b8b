"""The server of a watched run: a page, its events, a stop button. Only this machine reaches it, and only who knows its
token; it reads files and never speaks with the programs."""

import contextlib
import hmac
import http.server
import json
import secrets
import threading
import time
import urllib.parse

from toryu import results
from toryu.watch import feed

LOOPBACK = "127.0.0.1"
PAUSE = 0.5  # [s] between two looks at the folder
ALIVE = 10.0  # [s] of silence after which a comment is sent, by which a reader that went away is noticed
PATIENCE = 5.0  # [s] for a reader that does not read, or that sends no request
MOST_STREAMS = 8
MOST_CONNECTIONS = 32
HEADERS = {
    "Cache-Control": "no-store", "X-Content-Type-Options": "nosniff", "Referrer-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Content-Security-Policy": "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
                               "blob:; media-src blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
                               "frame-ancestors 'none'"}


class Server(http.server.ThreadingHTTPServer):
    """`make_page()` is the text of the page, before the end and after it."""

    daemon_threads = True

    def __init__(self, port, told, make_page):
        self.feed, self.make_page = told, make_page
        self.token = secrets.token_urlsafe(24)
        self.over = threading.Event()
        self.lock = threading.Lock()
        self.making = threading.Lock()  # one page at a time
        self.streams = 0
        self.opening = []  # when pages were asked for whose streams are not there yet [s]
        self.connected = 0  # whose answer is under way
        self.ended = 0  # streams that told the end, after which each page is asked for once more
        self.last_pages = 0  # read whole since the end
        super().__init__((LOOPBACK, port), Handler)

    @property
    def address(self):
        return f"http://{LOOPBACK}:{self.server_port}/{self.token}/"

    def still_opening(self):
        return [asked for asked in self.opening if time.monotonic() - asked < PATIENCE]

    def process_request(self, request, client_address):
        with self.lock:
            free = self.connected < MOST_CONNECTIONS
            self.connected += free
        if free:
            return super().process_request(request, client_address)
        self.shutdown_request(request)

    def process_request_thread(self, request, client_address):
        try:
            super().process_request_thread(request, client_address)
        finally:
            with self.lock:
                self.connected -= 1

    def handle_error(self, request, client_address):
        """A reader that went away is no fault, and there is nobody to tell of others: the page shows what it has."""

    def is_watched(self):
        with self.lock:
            return self.connected > 0 or self.last_pages < self.ended or bool(self.still_opening())

    def end(self):
        """Tells that the run is over, and closes when all who watched have the last page, or do not take it."""
        with self.lock:
            self.over.set()
        limit = time.monotonic() + PATIENCE
        while self.is_watched() and time.monotonic() < limit:
            if self.connected:  # however long an answer takes on a busy machine
                limit = time.monotonic() + PATIENCE
            time.sleep(0.02)
        self.shutdown()
        self.server_close()


class Handler(http.server.BaseHTTPRequestHandler):
    server_version, sys_version = "toryu", ""

    def setup(self):
        self.timeout = PATIENCE  # of each read and each write
        super().setup()

    def log_message(self, *_):
        pass

    def path_asked(self):
        """What is asked for below the token; None if the request may not come from this page or its user."""
        parts = urllib.parse.urlsplit(self.path).path.split("/")  # "", token, what
        own = {f"{name}:{self.server.server_port}" for name in (LOOPBACK, "localhost")}
        origin = self.headers.get("Origin")
        if (self.headers.get("Host") not in own or origin not in {None, *(f"http://{host}" for host in own)}
                or len(parts) != 3 or not hmac.compare_digest(parts[1].encode(), self.server.token.encode())):
            return None
        return parts[2]

    def do_GET(self):
        asked = self.path_asked()
        if asked == "":
            self.send_page()
        elif asked == "events":
            self.send_events()
        else:
            self.answer(404 if asked is not None else 403)

    def do_POST(self):
        """The stop button. A form of another page sends no such header without asking first, and is never allowed to."""
        asked = self.path_asked()
        if asked != "stop" or self.headers.get("X-Toryu") != "stop":
            return self.answer(404 if asked is not None and asked != "stop" else 403)
        if self.server.over.is_set():
            return self.answer(409)
        try:
            (self.server.feed.out / "stop").touch()
        except OSError:
            return self.answer(500)
        return self.answer(204)

    def answer(self, code, text=b"", kind="text/plain"):
        self.send_response(code)
        for name, value in {**HEADERS, "Content-Type": f"{kind}; charset=utf-8", "Content-Length": len(text)}.items():
            self.send_header(name, str(value))
        self.end_headers()
        self.wfile.write(text)

    def send_page(self):
        with self.server.lock:
            over = self.server.over.is_set()
            if not over:
                self.server.opening = [*self.server.still_opening(), time.monotonic()]
        with self.server.making:
            text = self.server.make_page().encode("utf-8", "backslashreplace")
        self.answer(200, text, "text/html")
        if over:
            with self.server.lock:
                self.server.last_pages += 1

    def send_events(self):
        with self.server.lock:
            del self.server.opening[:1]
            free = self.server.streams < MOST_STREAMS
            self.server.streams += free
        if not free:
            return self.answer(503)
        try:
            self.send_response(200)
            for name, value in {**HEADERS, "Content-Type": "text/event-stream"}.items():
                self.send_header(name, value)
            self.end_headers()
            Stream(self.server, self.wfile.write, self.cursor()).run()
            with self.server.lock:
                self.server.ended += 1
        finally:
            with self.server.lock:
                self.server.streams -= 1

    def cursor(self):
        """Byte of each series from which the page wants rows: where its last event ended, or where it began."""
        query = urllib.parse.parse_qs(urllib.parse.urlsplit(self.path).query)
        given = self.headers.get("Last-Event-ID") or query.get("from", ["{}"])[0]
        with contextlib.suppress(ValueError):
            if isinstance(found := json.loads(given), dict):
                return {name: max(0, start) if isinstance(start := found.get(name), int) else 0
                        for name in results.PARTICIPANTS}
        return dict.fromkeys(results.PARTICIPANTS, 0)


class Stream:
    """The events of one page. Nothing is kept for it but where it is, so that one who does not read costs nothing."""

    def __init__(self, server, write, cursor):
        self.server, self.feed, self.write, self.cursor = server, server.feed, write, cursor
        self.sent = {}  # kind of event -> the last one
        self.last = time.monotonic()

    def run(self):
        while True:
            over = self.server.over.is_set()  # before the last look
            while self.rows():
                pass
            self.changed("progress", self.feed.progress())
            self.changed("warnings", self.feed.warnings())
            if over:
                return self.send("end", "")
            self.frame()
            if time.monotonic() - self.last > ALIVE:
                self.write(b": alive\n\n")
                self.last = time.monotonic()
            self.server.over.wait(PAUSE)

    def send(self, kind, content):
        text = json.dumps(content, separators=(",", ":"))
        cursor = json.dumps(self.cursor, separators=(",", ":"))
        self.write(f"event: {kind}\nid: {cursor}\ndata: {text}\n\n".encode())
        self.last = time.monotonic()

    def changed(self, kind, content):
        if self.sent.get(kind) != content:
            self.send(kind, content)
            self.sent[kind] = content

    def rows(self):
        """Sends what is new of each series; whether there was any."""
        moved = False
        for name, start in self.cursor.items():
            content, end = feed.new_rows(self.feed.out, name, start)
            self.cursor[name] = end
            moved = moved or end > start
            if content:
                self.send("rows", content)
        return moved

    def frame(self):
        newest = self.feed.newest_frames()
        if newest != "[]" and self.sent.get("newest") != newest:
            with self.server.making, contextlib.suppress(*results.DAMAGED):
                content = self.feed.frame(newest)
                self.sent["newest"] = newest
            if self.sent.get("newest") == newest:
                self.send("frame", content)
