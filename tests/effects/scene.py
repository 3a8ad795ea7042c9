#!/usr/bin/env python3
"""scene.py NAME ROOT BUILD: only the effects that a scene of scenes.txt calls for (HARD-CASES Z1-Z4, Z6-Z8).

Z1  the frame as it is and the one with an unneeded effect switched off by name execute the same instructions (0.05 %)
Z2  and call no function of a technique that the plan does not name: every counter of theirs is 0      (Z4 as well)
Z3  what is off holds no byte: the plan's count is 0, and a renderer holds the same with it switched off by name
Z6  leaving out an effect that is needed changes the light of some pixel
Z7  forcing an effect on, each alone and all together, changes no bit
Z8  lanes shaded = covered distinct fragments; a pixel that one triangle covers is shaded once
What `scanout explain` says of each scene: tables.py.
"""
import json
import os
import subprocess
import sys

import callgrind
import scenes
import symbols

NAME, ROOT, BUILD = sys.argv[1], os.path.abspath(sys.argv[2]), os.path.abspath(sys.argv[3])
FRAMES = os.path.join(BUILD, "tests/effects_frames")
COUNTED, RENDER = "_Z7countedRN7scanout5frame8RendererE", "_ZN7scanout5frame8Renderer6renderE"
faults = []


def expect(right, what):
    if not right:
        faults.append(what)


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        scenes.fail(f"{' '.join(command)}: exit code {done.returncode}", done.stderr)
    return done.stdout


def check_costs(arguments):
    """Z1, Z2, Z4."""
    output, calls = callgrind.calls(COUNTED, RENDER, [FRAMES, "counts", *arguments])
    frames, calls = json.loads(output), calls[1::2]  # each is drawn twice; the first is not collected
    if len(calls) != len(frames):
        scenes.fail(f"callgrind saw {len(calls)} of {len(frames)} frames")
    whole = calls[0][0]
    expect(whole > 100_000, f"a frame of {whole} instructions: was it counted?")
    owners = symbols.read(BUILD)
    for frame, (instructions, ran) in zip(frames, calls):
        expect(abs(instructions - whole) <= whole * 0.0005,
               f"Z1: {frame['label']}: {instructions} instructions, {whole} as it is")
        ran = {owners[symbol] for symbol in ran if symbol in owners}
        for technique in sorted(ran - set(frame["techniques"])):
            expect(False, f"Z4: {frame['label']}: {technique} ran, the plan does not name it")
        for technique in sorted(set(frame["techniques"]) & set(owners.values()) - ran):
            expect(False, f"{frame['label']}: the plan names {technique}, nothing of it ran")
    return whole, len(frames) - 1


def check_laws(arguments):
    """Z3, Z6, Z7, Z8."""
    laws = json.loads(run(FRAMES, "laws", *arguments))
    for row in laws["effects"]:
        effect = row["effect"]
        if row["needed"]:
            expect(not row["off"]["same_light"], f"Z6: {effect} is said to be needed; without it the light is the same")
        else:
            expect(row["bytes"] == 0, f"Z3: {effect} is not needed and holds {row['bytes']} bytes")
            expect(row["off"]["held"] == laws["held"],
                   f"Z3: {effect}: {laws['held']} bytes, {row['off']['held']} when switched off by name")
            expect(row["off"]["same_picture"] and row["off"]["same_light"], f"{effect} is not needed; off it changes bits")
        expect(row["forced"]["same_picture"] and row["forced"]["same_light"], f"Z7: {effect} forced on changes bits")
    expect(laws["everything"]["same_picture"] and laws["everything"]["same_light"], "Z7: all forced on change bits")
    # Behind what is blended more than one fragment of a sample is shaded.
    expect(laws["lanes"] == laws["fragments"] or (laws["blended"] and laws["lanes"] > laws["fragments"]),
           f"Z8: {laws['lanes']} lanes shaded, {laws['fragments']} fragments are covered")
    return len(laws["effects"])


def main():
    arguments = scenes.arguments(ROOT, os.path.join(BUILD, "effects"), NAME)
    if arguments is None:
        print(f"{NAME}: its model is not on this machine")
        sys.exit(77)
    effects = check_laws(arguments)
    if callgrind.is_there():
        whole, switched = check_costs(arguments)
        print(f"{NAME}: {effects} effects, {switched} of them not needed, {whole} instructions")
    elif not faults:
        print("valgrind is not there: instructions are not counted")
        sys.exit(77)
    if faults:
        scenes.fail(*faults)


if __name__ == "__main__":
    main()
