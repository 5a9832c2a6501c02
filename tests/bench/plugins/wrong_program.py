"""A program engine that is right or wrong in one way:  wrong_program.py FAULT

Bodies fly freely. Faults that have the name of a call happen there; "hello" ones before anything was said.
"""

import os
import struct
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "core/plugin/clients"))
import broadside_engine  # noqa: E402

FAULT = sys.argv[1]
if log := os.environ.get("BROADSIDE_TEST_STARTS"):
    with open(log, "a", encoding="utf-8") as file:
        file.write("started\n")


class World:
    id, build, what = "wrong-program", "test 1, double", "wrong on demand"
    declared = {"contacts": "totals", "friction": "con" if FAULT == "declares-unknown-word" else "cone"}
    step_seconds = FAULT in ("step-says-an-hour", "tells-seconds")

    def begin(self, scene):
        self.gravity, self.states, self.steps = scene["gravity"], [dict(body) for body in scene["bodies"]], 0

    def step(self, dt):
        self.steps += 1
        if self.steps == 3 and FAULT == "step-raises":
            raise RuntimeError("the moon\nis full")
        if self.steps == 3 and FAULT == "step-takes-memory":
            self.hoard = bytearray(8 << 30)
        if self.steps == 3 and FAULT == "step-prints":
            print("step 3", flush=True)  # the client sends this to standard error
        for state in self.states:
            flown = zip(state["position"], state["velocity"], self.gravity)
            state["position"] = [x + dt * (v + dt / 2 * g) for x, v, g in flown]
            state["velocity"] = [v + dt * g for v, g in zip(state["velocity"], self.gravity)]
        return 3600.0 if FAULT == "step-says-an-hour" else 1e-9

    def read_states(self):
        return self.states[1:] if FAULT == "states-are-too-few" else self.states

    def read_points(self):
        point = {"a": 0, "b": broadside_engine.FIRST_FACE, "point": [0] * 3, "normal": [1, 0, 0], "gap": 1.0,
                 "impulse": [0] * 3}
        if FAULT == "impulse-is-nan":
            point["impulse"] = [0, float("nan"), 0]
        if FAULT == "point-names-no-body":
            point["a"] = 77
        return [point] if FAULT in ("impulse-is-nan", "point-names-no-body") else []


def spoil(payload, call):
    """Bytes instead of the answer, or None to leave now."""
    good = struct.pack("<II", len(payload) + 4, 0) + payload
    if FAULT == "hello-ends-early":
        return good[:20]
    if FAULT == "hello-goes-on":
        return struct.pack("<II", len(payload) + 9, 0) + payload + b"extra"
    if FAULT == "hello-of-version-9":
        return good.replace(b"BROADSID\x01", b"BROADSID\x09")
    if FAULT == "hello-has-no-end":
        return struct.pack("<II", 24, 0) + payload[:20]
    if call == 11 and FAULT == "step-answers-half":
        return good[:5]
    if call == 11 and FAULT == "step-answers-garbage":
        return b"step 1 done\n"
    if call == 12 and FAULT == "states-are-half":
        return struct.pack("<II", len(payload) // 2 + 4, 0) + payload[:len(payload) // 2]
    if call == 12 and FAULT == "states-claim-a-gigabyte":
        return struct.pack("<II", 1 << 30, 0) + payload
    return good


def main():
    if FAULT == "prints-first":
        sys.stdout.write("Hello, I am an engine.\n")
        sys.stdout.flush()
        time.sleep(60)
    if FAULT == "says-nothing":
        sys.exit(7)
    if FAULT in ("none", "tells-seconds", "step-raises", "step-prints", "step-takes-memory"):
        return broadside_engine.serve(World())
    engine = World()
    while len(head := sys.stdin.buffer.read(4)) == 4:
        message = sys.stdin.buffer.read(struct.unpack("<I", head)[0])
        call = struct.unpack_from("<I", message)[0]
        if FAULT == "never-answers-hello" or (call == 11 and FAULT == "never-answers-step"):
            time.sleep(600)
        if call == 11 and FAULT == "dies-at-step":
            print("the last words", file=sys.stderr, flush=True)
            os.kill(os.getpid(), 9)
        sent = spoil(broadside_engine.answer(engine, call, broadside_engine.Reader(message[4:])), call)
        sys.stdout.buffer.write(sent)
        sys.stdout.flush()
        if FAULT in ("hello-ends-early", "step-answers-half") and len(sent) <= 20 and sent != b"":
            if FAULT == "hello-ends-early" or call == 11:
                sys.exit(0)


main()
