#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How right the poses of many scans are, and sets of real scans to find out.

    evaluation/multiview.py judge DIR/poses.json TRUTH/truth.json [--json]
    evaluation/multiview.py prepare SET --data FOLDER --out DIR [--seed N]

judge takes what pcl_kss_icp_multiview wrote (graph.json beside poses.json, too, where it is
there) and says whether scans of one thing are in one group and no others, and how far the
poses are off. A group has a frame of its own: it is laid on the truth by the rigid motion
that makes the sum of the scans' misplacements least, so that a few lost scans do not move
the others. Laid on the truth by its first scan alone, too, it shows how far errors have
added up at its far end. The truth of a scan without "transformation" is the scan as it is:
those of its thing are in a common frame. The exit status is 1 where a scan is in a wrong
place or a wrong group, or a wrong pair is kept.

prepare writes scans of SET in random order and random frames to DIR, with truth.json.
FOLDER holds pairs/bunny, pairs/pcl_capture, scans/pairs.json and objects/.
pcl_kss_icp_virtual_scans does the work; --program says where it is.
"""
import argparse
import collections
import json
import pathlib
import random
import subprocess
import sys
import tempfile

import numpy as np

SETS = {  # kinds of scans/pairs.json
    "figurine": "turntable", "kitchen": "room", "frames": "frames", "facade": "facade",
    "lidar": "lidar"}
BAG_OBJECTS = ["armadillo.off", "ChineseDragon-10kv.off", "lion.off", "cow.off", "dino.off"]
# What makes a pose right: degrees, and the share of the scan's root mean square radius
# that its centroid may be off.
DEGREES, SHARE = 5.0, 0.1
PROGRAM = pathlib.Path(__file__).resolve().parents[1] / "build/benchmarks/pcl_kss_icp_virtual_scans"


# --- judge ---------------------------------------------------------------------------

class Scan:
    """What is known of a scan, and what was found."""

    def __init__(self, truth: dict, found: dict):
        self.file, self.thing, self.name = truth["file"], truth["thing"], truth["name"]
        self.true = np.array(truth.get("transformation", np.eye(4)), float)
        self.centroid, self.radius = np.array(truth["centroid"], float), truth["radius"]
        self.group = found["group"]
        self.found = None if self.group is None else np.array(found["transformation"], float)

    def landmarks(self) -> np.ndarray:
        """Six points that stand for the scan, in its own frame."""
        axes = np.vstack([np.eye(3), -np.eye(3)]) * self.radius
        return self.centroid + axes

    def errors(self, found: np.ndarray, true: np.ndarray):
        """Degrees, and how far the centroid is off."""
        return (degrees(found[:3, :3] @ true[:3, :3].T),
                float(np.linalg.norm(moved(found, self.centroid) - moved(true, self.centroid))))

    def tolerates(self, errors) -> bool:
        return errors[0] <= DEGREES and errors[1] <= SHARE * self.radius


def moved(pose: np.ndarray, points: np.ndarray) -> np.ndarray:
    return points @ pose[:3, :3].T + pose[:3, 3]


def degrees(rotation: np.ndarray) -> float:
    # the sine tells small angles, the cosine large ones
    sine = np.linalg.norm(rotation - rotation.T) / np.sqrt(8.0)
    return float(np.degrees(np.arctan2(sine, (np.trace(rotation) - 1.0) / 2.0)))


def random_rotation(draw: np.random.Generator) -> np.ndarray:
    rotation = np.linalg.qr(draw.normal(size=(3, 3)))[0]
    return rotation * np.sign(np.linalg.det(rotation))


def rigid_fit(source: np.ndarray, target: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """The rigid motion that maps the source's points to the target's best."""
    weights = weights / weights.sum()
    middles = weights @ source, weights @ target
    u, _, vt = np.linalg.svd((target - middles[1]).T @ (weights[:, None] * (source - middles[0])))
    u[:, 2] *= np.linalg.det(u @ vt)
    pose = np.eye(4)
    pose[:3, :3] = u @ vt
    pose[:3, 3] = middles[1] - pose[:3, :3] @ middles[0]
    return pose


def group_to_truth(scans: list) -> np.ndarray:
    """Maps the group's frame to that of the thing."""
    source = np.vstack([moved(scan.found, scan.landmarks()) for scan in scans])
    target = np.vstack([moved(scan.true, scan.landmarks()) for scan in scans])
    # the scan that most others agree with is a beginning that no lost scan spoils
    pose = min((scan.true @ np.linalg.inv(scan.found) for scan in scans),
               key=lambda start: np.linalg.norm(moved(start, source) - target, axis=1).sum())
    least = 1e-6 * max(scan.radius for scan in scans)
    for _ in range(50):
        misplaced = np.linalg.norm(moved(pose, source) - target, axis=1)
        pose = rigid_fit(source, target, 1.0 / np.maximum(misplaced, least))
    return pose


def judge(poses: pathlib.Path, truth: pathlib.Path) -> dict:
    scans = read_scans(poses, truth)
    groups = collections.defaultdict(list)
    for scan in scans:
        scan.right = False
        if scan.group is not None:
            groups[scan.group].append(scan)
    home = {}  # of each thing: the group that most of its scans are in
    for thing in {scan.thing for scan in scans}:
        counts = collections.Counter(scan.group for scan in scans
                                     if scan.thing == thing and scan.group is not None)
        home[thing] = max(counts, key=lambda group: (counts[group], -group), default=None)

    report = {"scans": len(scans), "things": len(home), "groups": [], "lost": [
        {"file": scan.file, "name": scan.name, "why": "it could not be used"}
        for scan in scans if scan.group is None]}
    for number, members in sorted(groups.items()):
        counts = collections.Counter(scan.thing for scan in members)
        thing = counts.most_common(1)[0][0]
        own = [scan for scan in members if scan.thing == thing]
        align = group_to_truth(own)
        for scan in members:
            scan.error = scan.errors(align @ scan.found, scan.true)
            scan.right = (scan.thing == thing and scan.tolerates(scan.error)
                          and home[thing] == number)
            if not scan.right:
                report["lost"].append(lost(scan, thing, home[thing] == number))
        report["groups"].append({
            "group": number, "scans": len(members), "thing": thing,
            "of_thing": sum(scan.thing == thing for scan in scans), "pure": len(counts) == 1,
            "right": sum(scan.right for scan in members),
            "rotation_deg": summary([scan.error[0] for scan in own]),
            "translation": summary([scan.error[1] for scan in own]),
            "drift": drift(own)})
    report["right"] = sum(scan.right for scan in scans)
    graph = poses.parent / "graph.json"
    if graph.exists():
        report["pairs"] = judge_pairs(scans, json.loads(graph.read_text())["pairs"])
    return report


def read_scans(poses: pathlib.Path, truth: pathlib.Path) -> list:
    """In the order of the poses."""
    known = {entry["file"]: entry for entry in json.loads(truth.read_text())["scans"]}
    scans = []
    for entry in json.loads(poses.read_text())["scans"]:
        name = pathlib.PurePath(entry["file"]).name
        if name not in known:
            sys.exit(f"{truth} does not tell where {name} is; give the truth of these scans")
        scans.append(Scan(known[name], entry))
    return scans


def lost(scan: Scan, thing: str, is_home: bool) -> dict:
    if scan.thing != thing:
        why = f"it shows {scan.thing} and is among scans of {thing}"
    elif not is_home:
        why = f"it is apart from most scans of {thing}"
    else:
        why = f"it is {scan.error[0]:.2f} deg and {scan.error[1]:.4g} m off"
    return {"file": scan.file, "name": scan.name, "why": why}


def summary(errors: list) -> dict:
    return {"median": float(np.median(errors)), "largest": float(np.max(errors))}


def drift(scans: list):
    """Laid on the truth by the first scan alone: how far the scan is off that is off most."""
    if len(scans) < 3:
        return None
    first = scans[0]
    if all(scan.name.isdigit() for scan in scans):  # numbers of the views
        first = min(scans, key=lambda scan: int(scan.name))
    align = first.true @ np.linalg.inv(first.found)
    errors = [scan.errors(align @ scan.found, scan.true) for scan in scans]
    far = max(range(len(scans)), key=lambda i: errors[i][1])
    return {"first": first.name, "name": scans[far].name,
            "rotation_deg": max(error[0] for error in errors), "translation": errors[far][1]}


def judge_pairs(scans: list, pairs: list) -> dict:
    known = {scan.file: scan for scan in scans}
    verdicts = collections.Counter()
    wrong = []
    rejected_right = 0
    for pair in pairs:
        verdict = pair["verdict"].lower()
        verdicts[verdict] += 1
        if pair.get("transformation") is None:
            continue
        source, target = (known[pathlib.PurePath(pair[end]).name]
                          for end in ("source_file", "target_file"))
        pose = np.array(pair["transformation"], float)
        errors = source.errors(pose, np.linalg.inv(target.true) @ source.true)
        right = source.thing == target.thing and source.tolerates(errors)
        if verdict == "kept" and not right:
            wrong.append({"source": source.file, "target": target.file,
                          "things": sorted({source.thing, target.thing}),
                          "rotation_deg": errors[0], "translation": errors[1]})
        rejected_right += verdict == "rejected" and right
    kept = verdicts["kept"]
    return {"verdicts": dict(verdicts), "kept_wrong": wrong,
            "kept_right_share": (kept - len(wrong)) / kept if kept else None,
            "rejected_right": rejected_right}


def print_report(report: dict):
    groups = report["groups"]
    pure = sum(group["pure"] for group in groups)
    alone = sum(group["scans"] == 1 for group in groups)
    print(f"{report['right']} of {report['scans']} scans right; {report['things']} things, "
          f"{len(groups)} groups ({alone} of a single scan), {pure} of them pure")
    for group in groups:
        if group["scans"] == 1:
            continue
        rotation, translation = group["rotation_deg"], group["translation"]
        print(f"group {group['group']}: {group['scans']} scans, {group['thing']} "
              f"({group['of_thing']} there are){'' if group['pure'] else ', NOT PURE'}; "
              f"{group['right']} right; rotation median {rotation['median']:.3f} largest "
              f"{rotation['largest']:.3f} deg; translation median "
              f"{translation['median']:.4g} largest {translation['largest']:.4g} m")
        if group["drift"]:
            far = group["drift"]
            print(f"  laid on the truth by scan {far['first']} alone: largest rotation "
                  f"{far['rotation_deg']:.3f} deg, far end ({far['name']}) off by "
                  f"{far['translation']:.4g} m")
    for scan in report["lost"]:
        print(f"lost: {scan['file']} ({scan['name']}): {scan['why']}")
    if "pairs" in report:
        pairs = report["pairs"]
        verdicts = ", ".join(f"{n} {name}" for name, n in sorted(pairs["verdicts"].items()))
        print(f"pairs: {verdicts}; {len(pairs['kept_wrong'])} kept that are wrong, "
              f"{pairs['rejected_right']} rejected that are right")
        if pairs["kept_right_share"] is not None:
            print(f"of the pairs that are kept, {pairs['kept_right_share']:.2%} are right")
        for pair in pairs["kept_wrong"]:
            print(f"  wrong: {pair['source']} on {pair['target']} ({', '.join(pair['things'])}):"
                  f" {pair['rotation_deg']:.2f} deg, {pair['translation']:.4g} m")


# --- prepare -------------------------------------------------------------------------

def bunny(data: pathlib.Path) -> list:
    return [entry(cloud, "bunny", np.loadtxt(cloud.with_suffix(".T_world.txt")))
            for cloud in sorted((data / "pairs/bunny").glob("*.pcd"))]


def capture(data: pathlib.Path) -> list:
    """A room by a depth camera that moves on; each frame has a pose to the one before."""
    folder = data / "pairs/pcl_capture"
    scans, pose = [entry(folder / "capture1.pcd", "capture", np.eye(4))], np.eye(4)
    for i in range(2, 6):
        pose = pose @ np.loadtxt(folder / f"{i}to{i - 1}_T_icp.txt")
        scans.append(entry(folder / f"capture{i}.pcd", "capture", pose))
    return scans


def chained(data: pathlib.Path, kind: str) -> list:
    """Scans that pairs of known poses connect; each such chain is a thing."""
    links = collections.defaultdict(list)
    for pair in json.loads((data / "scans/pairs.json").read_text()):
        if pair["kind"] == kind and not pair["refuse"]:
            pose = np.array(pair["poses"][0], float)
            links[pair["target"]].append((pair["source"], pose))
            links[pair["source"]].append((pair["target"], np.linalg.inv(pose)))
    scans, seen = [], set()
    for start in sorted(links):
        if start in seen:
            continue
        queue = collections.deque([(start, np.eye(4))])
        seen.add(start)
        while queue:
            file, pose = queue.popleft()
            scans.append(entry(data / "scans" / file, f"{kind} {pathlib.Path(start).stem}", pose))
            for other, step in links[file]:
                if other not in seen:
                    seen.add(other)
                    queue.append((other, pose @ step))
    return scans


def furniture(data: pathlib.Path) -> list:
    """Scans by hand that were laid on drawings of what they show; not the drawings."""
    scans = [scan for kind in ("cad", "cadsymmetric") for scan in chained(data, kind)
             if scan["name"].startswith("scan_")]
    for scan in scans:
        scan["thing"] = scan["name"].removeprefix("scan_").rsplit("_", 1)[0]
    return scans


def entry(cloud: pathlib.Path, thing: str, pose: np.ndarray) -> dict:
    return {"file": str(cloud.resolve()), "thing": thing, "name": cloud.stem,
            "transformation": pose.tolist()}


def prepare(arguments):
    data = arguments.data
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        truths = []
        if arguments.set == "bunny":
            scans = bunny(data)
        elif arguments.set == "bag":
            draw = random.Random(arguments.seed)
            for model in BAG_OBJECTS:
                views = scratch / model
                run(arguments.program, "turntable", "--model", data / "objects" / model,
                    "--scans", draw.randint(4, 6), "--turn", "none",
                    "--seed", arguments.seed, "--out", views)
                truths.append(views / "truth.json")
            # the frames show the kitchen, too, and nothing tells where in it
            scans = chained(data, "room") + capture(data)
        elif arguments.set == "mixed":
            scans = furniture(data) + [scan for kind in ("turntable", "room", "facade")
                                       for scan in chained(data, kind)]
        else:
            scans = chained(data, SETS[arguments.set])
            if arguments.set == "frames":
                scans = [scan for scan in scans if scan["thing"] == "frames frame000"]
        truths.append(scratch / "truth.json")
        truths[-1].write_text(json.dumps({"scans": scans}))
        run(arguments.program, "moved", *truths, "--out", arguments.out,
            "--seed", arguments.seed, "--shuffle")


def run(program: pathlib.Path, *arguments):
    if not program.exists():
        sys.exit(f"{program} is not there; build it (-DPCL_KSS_ICP_BUILD_BENCHMARKS=ON), or "
                 "name it with --program")
    status = subprocess.run([program, *map(str, arguments)]).returncode
    if status != 0:
        sys.exit(status)


# --- command line --------------------------------------------------------------------

def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, dest="command")
    judging = commands.add_parser("judge")
    judging.add_argument("poses", type=pathlib.Path)
    judging.add_argument("truth", type=pathlib.Path)
    judging.add_argument("--json", action="store_true", help="print JSON")
    preparing = commands.add_parser("prepare")
    preparing.add_argument("set", choices=["bunny", "bag", "mixed", *SETS])
    preparing.add_argument("--data", type=pathlib.Path, required=True)
    preparing.add_argument("--out", type=pathlib.Path, required=True)
    preparing.add_argument("--seed", type=int, default=1)
    preparing.add_argument("--program", type=pathlib.Path, default=PROGRAM)
    arguments = parser.parse_args()
    if arguments.command == "prepare":
        prepare(arguments)
        return 0
    report = judge(arguments.poses, arguments.truth)
    if arguments.json:
        print(json.dumps(report, indent=1))
    else:
        print_report(report)
    wrong_pairs = report.get("pairs", {}).get("kept_wrong", [])
    return 0 if report["right"] == report["scans"] and not wrong_pairs else 1


if __name__ == "__main__":
    sys.exit(main())
