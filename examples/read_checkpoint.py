#!/usr/bin/env python3
"""Reads a checkpoint or policy of ltl-rover with nothing but Python's own library.

    python3 examples/read_checkpoint.py runs/b1/policy.safetensors
    python3 examples/read_checkpoint.py runs/b1/policy.safetensors --module 1 --act 0.1,-0.2,0,0

The file is in the safetensors format: eight bytes with the length of a JSON header, the header, then the numbers, little-endian and
row-major. `safetensors.numpy.load_file` of the package `safetensors` reads it too. Weights are `[in, out]`: a layer is
`y = x @ weight + bias`, followed by layer norm where there are `gain` and `shift`, and by ReLU; the actor ends with tanh.
"""

import argparse
import array
import json
import math
import struct
import sys


def read(path):
    """The metadata (text by name) and the tensors (name -> (shape, numbers)) of a file."""
    with open(path, "rb") as file:
        data = file.read()
    (length,) = struct.unpack("<Q", data[:8])
    header = json.loads(data[8 : 8 + length])
    metadata = header.pop("__metadata__", {})
    tensors = {}
    for name, entry in header.items():
        if entry["dtype"] != "F32":
            raise SystemExit(f"{path}: tensor {name} holds {entry['dtype']}, not F32")
        begin, end = entry["data_offsets"]
        numbers = array.array("f", data[8 + length + begin : 8 + length + end])
        if sys.byteorder == "big":
            numbers.byteswap()
        tensors[name] = (entry["shape"], numbers)
    return metadata, tensors


def act(tensors, prefix, observation):
    """The action of the actor whose tensors begin with `prefix`, for one network input."""
    values = list(observation)
    layer = 0
    while f"{prefix}.{layer}.weight" in tensors:
        (inputs, outputs), weight = tensors[f"{prefix}.{layer}.weight"]
        _, bias = tensors[f"{prefix}.{layer}.bias"]
        if len(values) != inputs:
            raise SystemExit(f"{prefix}.{layer} reads {inputs} numbers, not {len(values)}")
        sums = [bias[o] + sum(values[i] * weight[i * outputs + o] for i in range(inputs)) for o in range(outputs)]
        layer += 1
        if f"{prefix}.{layer}.weight" not in tensors:
            return [math.tanh(x) for x in sums]
        if f"{prefix}.{layer - 1}.gain" in tensors:
            _, gain = tensors[f"{prefix}.{layer - 1}.gain"]
            _, shift = tensors[f"{prefix}.{layer - 1}.shift"]
            mean = sum(sums) / outputs
            scale = 1 / math.sqrt(sum((x - mean) ** 2 for x in sums) / outputs + 1e-5)
            sums = [(x - mean) * scale * g + s for x, g, s in zip(sums, gain, shift)]
        values = [max(x, 0.0) for x in sums]
    raise SystemExit(f"there is no {prefix}.0.weight in the file")


def main():
    parser = argparse.ArgumentParser(description="Reads a checkpoint or policy of ltl-rover.")
    parser.add_argument("file")
    parser.add_argument("--act", metavar="X,X,…", help="print the action for these network inputs")
    parser.add_argument("--prefix", default="module.", help="what tensor names begin with (default: module.)")
    parser.add_argument("--module", type=int, default=0, help="whose actor acts (default: 0)")
    arguments = parser.parse_args()
    metadata, tensors = read(arguments.file)
    if arguments.act:
        observation = [float(x) for x in arguments.act.split(",")]
        print(json.dumps(act(tensors, f"{arguments.prefix}{arguments.module}.actor", observation)))
        return
    for name, text in sorted(metadata.items()):
        lines = text.splitlines() or [""]
        print(f"{name:12} {lines[0]}" + (f"   … {len(lines)} lines" if len(lines) > 1 else ""))
    print()
    for name, (shape, numbers) in sorted(tensors.items()):
        size = math.sqrt(sum(x * x for x in numbers) / len(numbers)) if numbers else 0.0
        print(f"{name:40} {str(shape):14} root mean square {size:.4g}")


if __name__ == "__main__":
    main()
