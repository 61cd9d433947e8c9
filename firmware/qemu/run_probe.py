#!/usr/bin/env python3
"""Runs the firmware on an emulated microcontroller, its UART bridged to `asperity record`, and prints what both ends counted.

    run_probe.py --machine microbit --elf probe.elf --seconds 60 --scenario clean --asperity build/release/bin/asperity --out DIR

The emulator's time is that of the instructions (-icount) and is held to the host's (align=on), so that a host that is busy
makes it late, but costs no sample. The bridge is a pseudo-terminal: `record` opens it as it opens a USB serial port.
DIR gets the recording, report.json, record.log and qemu.log. Exit code 1: a check failed.
"""
import argparse
import errno
import fcntl
import json
import os
import select
import shutil
import socket
import subprocess
import sys
import termios
import time
import tty

from check_run import check_run

INSTRUCTION_SHIFT = 4  # an instruction takes 2**4 ns: 62.5 million a second


def start_record(asperity, port, out):
    log = open(out + '/record.log', 'w')
    report = open(out + '/report.json', 'w')
    # A silent port is opened again after a second, and what comes meanwhile is lost. An emulator on a busy host may be late by
    # as much: here it is given a minute.
    command = [asperity, 'record', '--probe', 'serial:%s@921600' % port, '--set', 'recorder.stale_s=60', '--uncalibrated',
               '--json', '-o', out + '/recording']
    return subprocess.Popen(command, stdout=report, stderr=log, stdin=subprocess.DEVNULL)


def wait_until_opened(master, record):
    """A pseudo-terminal hangs up until its other end has been opened."""
    for _ in range(600):
        if record.poll() is not None:
            raise SystemExit('run_probe: asperity record ended before it had opened the port; see record.log')
        if is_open(master):
            return
        time.sleep(0.05)
    raise SystemExit('run_probe: asperity record has not opened the port')


def start_qemu(machine, elf, seconds, scenario, port, out):
    command = ['qemu-system-arm', '-M', machine, '-kernel', elf, '-display', 'none', '-monitor', 'none',
               '-icount', 'shift=%d,align=on' % INSTRUCTION_SHIFT,
               '-semihosting-config', 'enable=on,target=native,arg=probe,arg=%d,arg=%s' % (seconds, scenario),
               '-serial', 'tcp:127.0.0.1:%d' % port]
    log = open(out + '/qemu.log', 'w')
    return subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL)


def accept(listener, qemu):
    listener.settimeout(0.5)
    for _ in range(40):
        try:
            line, _ = listener.accept()
            line.settimeout(None)
            return line
        except socket.timeout:
            if qemu.poll() is not None:
                raise SystemExit('run_probe: qemu ended at once; see qemu.log')
    raise SystemExit('run_probe: qemu has not opened its serial line')


def is_open(master):
    poll = select.poll()
    poll.register(master, select.POLLIN)
    return not any(event & select.POLLHUP for _, event in poll.poll(0))


def write_all(fd, data, record):
    """Where `record` has closed the port, as it does to open it again after a silence, the bytes are lost."""
    while data and is_open(fd):
        if not select.select([], [fd], [], 1.0)[1]:
            if record.poll() is not None:
                raise SystemExit('run_probe: asperity record ended early; see record.log')
            continue
        data = data[os.write(fd, data):]


def bridge(line, master, qemu, record, limit_s):
    """Bytes both ways until the emulator ends. Returns how many came from it."""
    received = 0
    end = time.monotonic() + limit_s
    while time.monotonic() < end:
        ready = select.select([line, master] if is_open(master) else [line], [], [], 0.05)[0]
        if line in ready:
            data = line.recv(65536)
            if not data:
                return received
            received += len(data)
            write_all(master, data, record)
        if master in ready:
            try:
                line.sendall(os.read(master, 4096))
            except OSError as error:
                if error.errno != errno.EIO:
                    raise
        if record.poll() is not None:
            qemu.kill()
            raise SystemExit('run_probe: asperity record ended early; see record.log')
    qemu.kill()
    raise SystemExit('run_probe: the emulator did not end within %d s' % limit_s)


def drain(master):
    """Waits until `record` has read all that was written."""
    waiting = bytearray(4)
    for _ in range(400):
        fcntl.ioctl(master, termios.TIOCOUTQ, waiting)
        if int.from_bytes(waiting, 'little') == 0:
            break
        time.sleep(0.01)
    time.sleep(0.3)  # for the round in which it writes


def run(options):
    shutil.rmtree(options.out, ignore_errors=True)
    os.makedirs(options.out)
    master, slave = os.openpty()
    tty.setraw(slave)
    port = os.ttyname(slave)
    os.close(slave)
    os.set_blocking(master, False)
    record = start_record(options.asperity, port, options.out)
    qemu = None
    try:
        wait_until_opened(master, record)
        # Of one byte at a time a local socket holds some hundred, TCP's as many as it has room for.
        listener = socket.create_server(('127.0.0.1', 0))
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        qemu = start_qemu(options.machine, options.elf, options.seconds, options.scenario, listener.getsockname()[1],
                          options.out)
        line = accept(listener, qemu)
        began = time.monotonic()
        received = bridge(line, master, qemu, record, 5 * options.seconds + 120)
        elapsed = time.monotonic() - began
        drain(master)
        record.terminate()  # not SIGINT: a shell has what it runs in the background ignore it
        record.wait(60)
        qemu.wait(10)
    finally:
        for process in (record, qemu):
            if process is not None and process.poll() is None:
                process.kill()
                process.wait()
    return {'bridged_bytes': received, 'elapsed_s': elapsed, 'record_exit': record.returncode, 'qemu_exit': qemu.returncode}


def read_guest(path):
    out = {}
    for line in open(path):
        name, equals, value = line.strip().partition('=')
        if equals and value.isdigit():
            out[name] = int(value)
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--machine', required=True)
    parser.add_argument('--elf', required=True)
    parser.add_argument('--seconds', type=int, default=60)
    parser.add_argument('--scenario', choices=['clean', 'faults', 'absent'], default='clean')
    parser.add_argument('--asperity', required=True)
    parser.add_argument('--out', required=True)
    options = parser.parse_args()
    ends = run(options)
    guest = read_guest(options.out + '/qemu.log')
    text = open(options.out + '/report.json').read()
    if 'rows_made' not in guest or not text:
        raise SystemExit('run_probe: an end has not reported; see %s/qemu.log and record.log' % options.out)
    failures = check_run(options, ends, guest, json.loads(text), INSTRUCTION_SHIFT)
    for failure in failures:
        print('FAILED: ' + failure)
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())
