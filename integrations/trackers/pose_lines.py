"""Lines of poses for `asperity record --poses` (docs/trackers.md): to standard output, or by UDP."""
import math
import os
import socket
import sys

HALF = math.sqrt(0.5)


def host_port(text, default_port=None):
    """'HOST:PORT', or 'HOST' where there is a default port."""
    host, colon, port = text.rpartition(":")
    if not colon:
        host, port = text, default_port
    try:
        port = int(port)
    except (TypeError, ValueError):
        raise SystemExit(f"'{text}' is not HOST:PORT") from None
    if not host or not 0 < port < 65536:
        raise SystemExit(f"'{text}' is not HOST:PORT")
    return host, port


def rotated_up(position_m, xyzw):
    """A pose of a world with y up in the same world with z up: its x stays, its -z becomes y."""
    (px, py, pz), (x, y, z, w) = position_m, xyzw
    return (px, -pz, py), (HALF * (x + w), HALF * (y - z), HALF * (z + y), HALF * (w - x))


class PoseOutput:
    """Writes T_world_marker, metres, and counts what is not a pose. By UDP a line has the sender's time, of any clock
    that counts ns; on standard output the time is left empty: the recorder takes that of arrival."""

    def __init__(self, udp=None, body="", y_up=False):
        self._address = host_port(udp) if udp else None
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM) if udp else None
        self._body = body + "," if body else ""
        self._y_up = y_up
        self.sent = self.refused = 0

    def write(self, t_ns, position_m, xyzw):
        norm = math.sqrt(sum(value * value for value in xyzw))
        if not abs(norm - 1.0) < 0.01 or not all(math.isfinite(value) for value in position_m):
            self.refused += 1
            return
        xyzw = [value / norm for value in xyzw]
        if self._y_up:
            position_m, xyzw = rotated_up(position_m, xyzw)
        time = str(t_ns) if self._socket and t_ns is not None else ""
        x, y, z, w = xyzw
        numbers = ",".join(f"{value:.9g}" for value in (*position_m, w, x, y, z))
        line = f"{self._body}{time},{numbers}\n"
        if self._socket:
            self._socket.sendto(line.encode(), self._address)
        else:
            sys.stdout.write(line)
            sys.stdout.flush()
        self.sent += 1


def add_options(parser):
    parser.add_argument("--udp", metavar="HOST:PORT", help="send each pose there, for `asperity record --poses udp:PORT`; else print them")
    parser.add_argument("--body", metavar="NAME", default="", help="begin each line with this name, for `asperity record --body NAME`")
    parser.add_argument("--y-up", action="store_true", help="the tracker's y points up: rotate the world so that z does (--world z_up)")


def run(options, send):
    """Calls send(PoseOutput) until it ends, the reader is gone or Ctrl-C; then states the counts."""
    output = PoseOutput(options.udp, options.body, options.y_up)
    try:
        send(output)
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # Python flushes it once more at the end
    except OSError as error:
        raise SystemExit(str(error)) from None
    finally:
        refused = f", {output.refused} refused (not finite, or not a rotation)" if output.refused else ""
        print(f"{output.sent} poses{refused}", file=sys.stderr)
