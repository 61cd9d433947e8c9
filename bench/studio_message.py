#!/usr/bin/env python3
"""One large message to the studio, and what another window's heartbeat waits for meanwhile.

    bench/studio_message.py build/release/bin/asperity [KILOBYTES]

Of 9 messages of KILOBYTES (600 unless told) prints the time until the studio has answered, and the longest time that a
second window, which asks every 5 ms, waited for `studio.ping` meanwhile: the median and the most. Two kinds of text: a
list of empty objects (at most 199,000, what the studio takes), which is the most values a byte, and one long string.
"""
import base64, http.client, json, os, re, socket, statistics, struct, subprocess, sys, tempfile, threading, time


def sign_in(host, port, token):
    """The cookie, which all windows of a browser share."""
    connection = http.client.HTTPConnection(host, port)
    connection.request("POST", "/session", json.dumps({"token": token}),
                       {"Content-Type": "application/json", "Origin": f"http://{host}:{port}"})
    return connection.getresponse().getheader("Set-Cookie").split(";")[0]


class Window:
    def __init__(self, host, port, cookie):
        self.socket = socket.create_connection((host, port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\nOrigin: http://{host}:{port}\r\n"
                             f"Cookie: {cookie}\r\n\r\n").encode())
        self.bytes = self.socket.makefile("rb")
        assert b"101" in self.bytes.readline()
        while self.bytes.readline().strip():
            pass
        self.id = 0

    def send(self, text):
        data = text.encode()
        if len(data) < 126: size = struct.pack("!BB", 0x81, 0x80 | len(data))
        elif len(data) < 65536: size = struct.pack("!BBH", 0x81, 0xFE, len(data))
        else: size = struct.pack("!BBQ", 0x81, 0xFF, len(data))
        self.socket.sendall(size + b"\0\0\0\0" + data)  # masked by zeros

    def receive(self):
        _, length = struct.unpack("!BB", self.bytes.read(2))
        if length == 126: length = struct.unpack("!H", self.bytes.read(2))[0]
        elif length == 127: length = struct.unpack("!Q", self.bytes.read(8))[0]
        return self.bytes.read(length)

    def call(self, name, args="{}"):
        """Seconds until the answer, and whether it was a refusal."""
        self.id += 1
        text = f'{{"id":{self.id},"call":"{name}","args":{args}}}'
        start = time.perf_counter()
        self.send(text)
        while True:
            frame = self.receive()
            if not frame.startswith(b"{"): continue
            answer = json.loads(frame)
            if answer.get("id") == self.id: return time.perf_counter() - start, answer.get("error")


def main():
    size = 1000 * int(sys.argv[2]) if len(sys.argv) > 2 else 600_000
    with tempfile.TemporaryDirectory() as folder:
        measure(size, folder)


def measure(size, folder):
    studio = subprocess.Popen([sys.argv[1], "studio", folder, "--no-open"], stdout=subprocess.PIPE, text=True)
    try:
        host, port, token = re.search(r"http://([^:/]+):(\d+)/#token=(\S+)", studio.stdout.readline()).groups()
        cookie = sign_in(host, int(port), token)
        one, other = Window(host, int(port), cookie), Window(host, int(port), cookie)
        values = min((size - 100) // 3, 199_000)
        for kind, value in (("empty objects", "[" + ",".join(["{}"] * values) + "]"),
                            ("one string", json.dumps("x" * (size - 100)))):
            took, waited = [], []
            for _ in range(9):
                over = threading.Event()
                waits = []
                def beat():
                    while not (over.is_set() and waits):
                        waits.append(other.call("studio.ping")[0])
                        time.sleep(0.005)
                beats = threading.Thread(target=beat)
                beats.start()
                seconds, error = one.call("document.edit", f'{{"path":"/bench/x","value":{value},"label":"x","gesture":""}}')
                over.set()
                beats.join()
                took.append(seconds)
                waited.append(max(waits))
            print(f"{kind}, {len(value) // 1000} kB{' (refused: ' + error['message'] + ')' if error else ''}: answered "
                  f"after {1e3 * statistics.median(took):.1f} ms (most {1e3 * max(took):.1f}); the other window's ping "
                  f"waited at most {1e3 * statistics.median(waited):.1f} ms (most {1e3 * max(waited):.1f})")
    finally:
        studio.terminate()
        studio.wait()


main()
