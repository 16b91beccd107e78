# Run by scripts/bench-cycles: welkin and Cycles on the same glTF scene, map and threads. Prints whether both converge to
# the same picture, and the RMSE of each against converged pictures at equal time.
#   compare.py WELKIN FOLDER MAP.hdr [ROUGHNESS [SIZE [REFERENCE_SAMPLES]]]
import json
import os
import re
import statistics
import subprocess
import sys
import time

here = os.path.dirname(os.path.abspath(__file__))
welkin, folder, map_path = sys.argv[1], sys.argv[2], os.path.abspath(sys.argv[3])
roughness, size, reference_samples = (sys.argv[4:] + ["0.1", "256", "4096"][len(sys.argv) - 4:])[:3]
threads = str(os.cpu_count())
scene = os.path.join(folder, "sphere-plane.glb")


def run(arguments):
    done = subprocess.run(arguments, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"bench-cycles: {' '.join(arguments)} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def blender(*arguments):
    return run(["blender", "-b", "--factory-startup", "-P", os.path.join(here, "sphere_plane.py"), "--", *arguments])


def cycles(samples, seed, out):
    text = blender("render", scene, map_path, roughness, size, str(samples), str(seed), threads, out)
    if not os.path.exists(out):
        sys.exit(f"bench-cycles: Blender rendered nothing:\n{text[-2000:]}")
    return float(re.search(r"cycles seconds ([0-9.]+)", text).group(1))


def ours(samples, seed, out):
    start = time.monotonic()
    run([welkin, "render", scene, "--env", map_path, "--size", f"{size}x{size}", "--spp", str(samples), "--seed", str(seed),
         "-o", out])
    return time.monotonic() - start


def difference(a, b):
    return json.loads(run([welkin, "compare", a, b, "--json"]))["parts"][0]


def at(name):
    return os.path.join(folder, name + ".exr")


def converge():
    print(f"converged pictures, {size} x {size}, {reference_samples} samples a pixel", flush=True)
    for seed in (101, 102):
        ours(reference_samples, seed, at(f"welkin-{seed}"))
        cycles(reference_samples, seed, at(f"cycles-{seed}"))
    noise_ours = difference(at("welkin-101"), at("welkin-102"))["relative_rmse"]
    noise_cycles = difference(at("cycles-101"), at("cycles-102"))["relative_rmse"]
    across = [difference(at(f"welkin-{a}"), at(f"cycles-{b}"))["relative_rmse"] for a in (101, 102) for b in (101, 102)]
    expected = ((noise_ours ** 2 + noise_cycles ** 2) / 2) ** 0.5
    print(f"relative RMS difference of two seeds: welkin {noise_ours:.2e}, Cycles {noise_cycles:.2e}")
    print(f"between the two renderers: {statistics.mean(across):.2e}; {expected:.2e} expected from noise alone")


# Cycles' time is that of its render call, without the start of Blender and the import; ours is the whole command.
def equal_time(samples, seed):
    seconds_cycles = cycles(samples, seed, at("cycles-short"))
    probe = ours(samples, seed, at("welkin-short"))
    count = max(1, round(samples * seconds_cycles / probe))
    seconds_ours = ours(count, seed, at("welkin-short"))
    error_ours = difference(at("welkin-short"), at("welkin-101"))["rmse"]
    error_cycles = difference(at("cycles-short"), at("cycles-101"))["rmse"]
    print(f"Cycles {samples:5d} samples {seconds_cycles:6.2f} s RMSE {error_cycles:.4f}   "
          f"welkin {count:5d} samples {seconds_ours:6.2f} s RMSE {error_ours:.4f}   "
          f"ratio at equal time {error_ours / error_cycles * (seconds_ours / seconds_cycles) ** 0.5:.2f}", flush=True)


os.makedirs(folder, exist_ok=True)
blender("make", scene, roughness)
converge()
for short_samples in (16, 64, 256):
    for short_seed in (1, 2, 3):
        equal_time(short_samples, short_seed)
