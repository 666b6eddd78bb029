"""A client of `hersey open` over the loopback address, of the standard library alone."""

import http.client
import json
import os
import signal
import subprocess
import time
import urllib.parse


class Answer:
    """Status, headers and body of a reply."""

    def __init__(self, status, headers, body):
        self.status, self.headers, self.body = status, headers, body

    @property
    def text(self):
        return self.body.decode("utf-8")

    @property
    def json(self):
        return json.loads(self.body)


class Workbench:
    """A server of its own on a folder; `log` is a file that receives what it prints besides its address."""

    def __init__(self, program, path, log, *options, preexec=None):
        self.log_file = log
        with open(log, "ab") as errors:
            self.process = subprocess.Popen([program, "open", path, "--no-browser", *options], stdout=subprocess.PIPE, stderr=errors,
                                            text=True, preexec_fn=preexec)  # pylint: disable=subprocess-popen-preexec-fn
        self.address = self.process.stdout.readline().strip()
        parts = urllib.parse.urlsplit(self.address)
        self.port = parts.port
        self.token = parts.fragment.removeprefix("token=")

    def request(self, method, path, body=None, headers=None, token=True, timeout=30):
        """Sends a request as the page does; `headers` replace its own, None leaves one out."""
        sent = {"Host": f"127.0.0.1:{self.port}"}
        if token:
            sent["Authorization"] = "Bearer " + self.token
        for name, value in (headers or {}).items():
            sent.pop(name, None)
            if value is not None:
                sent[name] = value
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
            data = body.encode() if isinstance(body, str) else body
            if data is None and method in ("POST", "PUT"):
                data = b""
            if data is not None and "Content-Length" not in sent and "Transfer-Encoding" not in sent:
                sent["Content-Length"] = str(len(data))
            for name, value in sent.items():
                connection.putheader(name, value)
            connection.endheaders(data)
            reply = connection.getresponse()
            return Answer(reply.status, dict((k.lower(), v) for k, v in reply.getheaders()), reply.read())
        finally:
            connection.close()

    def get(self, path, **more):
        return self.request("GET", path, **more)

    def post(self, path, document=None, **more):
        return self.request("POST", path, json.dumps(document if document is not None else {}), **more)

    def file(self, name):
        return self.get("/api/file?path=" + urllib.parse.quote(name))

    def put(self, name, text, etag=None):
        mark = {"If-Match": etag} if etag else {"If-None-Match": "*"}
        return self.request("PUT", "/api/file?path=" + urllib.parse.quote(name), text, headers=mark)

    def run_of(self, name):
        return next(run for run in self.get("/api/runs").json["runs"] if run["id"] == name)

    def wait_for(self, name, *states, seconds=30):
        end = time.time() + seconds
        while time.time() < end:
            run = self.run_of(name)
            if run["state"] in states:
                return run
            time.sleep(0.05)
        raise AssertionError(f"{name} is {run['state']} and not {states}: {self.get(f'/api/runs/{name}/log').text}")

    def log(self):
        with open(self.log_file, encoding="utf-8") as file:
            return file.read()

    def is_alive(self):
        return self.process.poll() is None and self.get("/api/hello").status == 200

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        code = self.process.wait(timeout=20)
        self.process.stdout.close()
        return code

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class Events:
    """A stream of events, read as the page reads it."""

    def __init__(self, workbench, after=None):
        self.connection = http.client.HTTPConnection("127.0.0.1", workbench.port, timeout=30)
        path = "/api/events" + (f"?after={after}" if after is not None else "")
        self.connection.request("GET", path, headers={"Authorization": "Bearer " + workbench.token})
        self.reply = self.connection.getresponse()

    def next(self):
        """(number, name, data) of the next event; comments are skipped."""
        number = name = data = None
        end = time.time() + 20  # comments keep the connection alive
        while time.time() < end:
            line = self.reply.readline().decode("utf-8")
            if not line:
                raise ConnectionError("the stream has ended")
            line = line.rstrip("\n")
            if line.startswith("id: "):
                number = int(line[4:])
            elif line.startswith("event: "):
                name = line[7:]
            elif line.startswith("data: "):
                data = json.loads(line[6:])
            elif not line and name is not None:
                return number, name, data
        raise TimeoutError("no event has come")

    def close(self):
        # http.client leaves the socket open as long as the reply is.
        self.reply.close()
        self.connection.close()


def start_of(pid):
    """Time of a process's start, in the system's ticks."""
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        return int(file.read().rsplit(")", 1)[1].split()[19])


def write(folder, name, text):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path
