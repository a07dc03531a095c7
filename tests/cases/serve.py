# SPDX-License-Identifier: GPL-3.0-or-later
"""A client of `tunica serve` that speaks the UM-Bridge protocol as its text says, and others that do not.

    serve.py TUNICA SCENE
"""
import json
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor

tunica, scene = sys.argv[1:3]
inputs = "outlet.resistance,tether.stiffness"
# Differences of evaluations show the steps of looser tolerances.
arguments = [tunica, "serve", scene, "--tier", "lumped", "--set", "accuracy.tolerance=1e-6", "--inputs", inputs,
             "--outputs", "pressure.max,radial_displacement.P1.change"]
server = subprocess.Popen(arguments + ["--port", "0", "--jobs", "2"], stdout=subprocess.PIPE, text=True)
address = re.match(r"(http://127\.0\.0\.1:(\d+)): ", server.stdout.readline())
url, port = address.group(1), int(address.group(2))


def ask(path, body=None):
    """Status and JSON of a reply; a body that is no bytes is sent as JSON."""
    data = body if body is None or isinstance(body, bytes) else json.dumps(body).encode()
    request = urllib.request.Request(url + path, data=data, headers={"Content-Type": "application/json"})
    try:
        with urllib.request.urlopen(request, timeout=60) as reply:
            return reply.status, json.load(reply)
    except urllib.error.HTTPError as error:
        return error.code, json.load(error)


def refused(path, body, kind, status=400):
    got, reply = ask(path, body)
    assert (got, reply["error"]["type"]) == (status, kind), (path, body, got, reply)
    assert reply["error"]["message"], reply


def evaluate(resistance, stiffness):
    status, reply = ask("/Evaluate", {"name": "forward", "input": [[resistance, stiffness]], "config": {}})
    assert status == 200, reply
    return reply["output"][0]


try:
    # The model describes itself.
    name = {"name": "forward", "config": {}}
    assert ask("/Info") == (200, {"protocolVersion": 1.0, "models": ["forward"]})
    assert ask("/InputSizes", name) == (200, {"inputSizes": [2]})
    assert ask("/OutputSizes", name) == (200, {"outputSizes": [2]})
    support = {"Evaluate": True, "Gradient": True, "ApplyJacobian": True, "ApplyHessian": False}
    assert ask("/ModelInfo", name)[1]["support"] == support

    # Derivatives agree with differences of evaluations, to what central ones over 1 % are worth.
    at = [1e6, 1e7]
    columns = []
    for k in range(2):
        low, high = [list(at), list(at)]
        low[k] *= 0.99
        high[k] *= 1.01
        columns.append([(b - a) / (0.02 * at[k]) for a, b in zip(evaluate(*low), evaluate(*high))])
    common = {"name": "forward", "outWrt": 0, "inWrt": 0, "input": [at], "config": {}}
    for k in range(2):
        vec = [float(j == k) for j in range(2)]
        moved = ask("/ApplyJacobian", {**common, "vec": vec})[1]["output"]
        turned = ask("/Gradient", {**common, "sens": vec})[1]["output"]
        for i in range(2):
            assert abs(moved[i] - columns[k][i]) < 2e-3 * abs(columns[k][i]), (moved, columns[k])
            assert abs(turned[i] - columns[i][k]) < 2e-3 * abs(columns[i][k]), (turned, columns)

    # Many at once are answered like one by one.
    points = [(8e5 + 2e4 * k, 1e7) for k in range(24)]
    with ThreadPoolExecutor(12) as pool:
        together = list(pool.map(lambda point: evaluate(*point), points))
    assert together[::8] == [evaluate(*point) for point in points[::8]]
    assert all(a[0] < b[0] for a, b in zip(together, together[1:])), "a larger resistance raises the pressure"

    # What makes no sense is told as an error object, and nothing ends.
    good = {"name": "forward", "input": [at]}
    for body in (b"", b"no JSON", b"[]", b"[" * 100000, b"\xff\xfe", {"name": "forward"},
                 {**good, "input": [1, 2]}, {**good, "input": [[1e6]]}, {**good, "input": [[1e6, "1e7"]]},
                 {**good, "input": [at, at]},
                 {**good, "input": [[-1, 1e7]]}, {**good, "config": {"level": 1}}, {"input": [at]},
                 b'{"name": "forward", "input": [[1e999, 1e7]]}',
                 b'{"name": "forward", "input": [[NaN, 1e7]]}'):
        refused("/Evaluate", body, "InvalidInput")
    refused("/Evaluate", {**good, "name": "other"}, "ModelNotFound")
    refused("/Gradient", {**common, "sens": [1]}, "InvalidInput")
    refused("/Gradient", {**common, "sens": [1, 0], "outWrt": 1}, "InvalidInput")
    hessian = {**common, "sens": [1, 0], "vec": [1, 0], "inWrt1": 0, "inWrt2": 0}
    refused("/ApplyHessian", hessian, "UnsupportedFeature")
    refused("/Nowhere", good, "UnsupportedFeature", 404)
    # A wall that the pressure bursts is an answer that there is not.
    refused("/Evaluate", {**good, "input": [[1e12, 1e3]]}, "InvalidOutput", 500)

    # Too long, cut off, or no HTTP at all.
    with socket.create_connection(("127.0.0.1", port), timeout=20) as wire:
        wire.sendall(b"POST /Evaluate HTTP/1.1\r\nHost: x\r\nContent-Length: 5000000\r\n\r\n" + b" " * 1000)
        reply = wire.recv(4096).decode()
    assert " 413 " in reply.splitlines()[0], reply
    with socket.create_connection(("127.0.0.1", port), timeout=20) as wire:
        wire.sendall(b"POST /Evaluate HTTP/1.1\r\nHost: x\r\nContent-Length: 500\r\n\r\n{")
    with socket.create_connection(("127.0.0.1", port), timeout=20) as wire:
        wire.sendall(bytes(range(256)) * 8)
    assert len(evaluate(*at)) == 2

    # A second server cannot have the port.
    second = subprocess.run(arguments + ["--port", str(port)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, timeout=60)
    assert second.returncode == 2 and second.stderr.count("\n") == 1 and "--port" in second.stderr, second

    server.send_signal(signal.SIGINT)
    assert server.wait(20) == 0
finally:
    server.kill()
