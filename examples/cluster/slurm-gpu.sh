#!/usr/bin/env bash
#SBATCH --job-name=impact-atlas-gpu
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --gpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=part-%a.log

# One part of the plane on the GPU of one task:  sbatch --array=1-64 slurm-gpu.sh
set -euo pipefail
cd "${SLURM_SUBMIT_DIR:-.}"
source ./plane.sh
part=$SLURM_ARRAY_TASK_ID/${PARTS:-$SLURM_ARRAY_TASK_MAX}

# Slurm numbers the GPUs of the node; Vulkan sees all of them, in another order. The address on the PCI bus is the same to
# both. Inside a constrained cgroup nvidia-smi sees the task's own GPU alone.
adapter=()
if command -v nvidia-smi >/dev/null; then
    address=$(nvidia-smi --query-gpu=pci.bus_id --format=csv,noheader | head -n 1)
    adapter=(--adapter "$address")
elif [ -n "${ADAPTER:-}" ]; then
    adapter=(--adapter "$ADAPTER")
fi
if [ "$("$IMPACT_ATLAS" adapters --json)" = "[]" ]; then
    echo "$(hostname) has no Vulkan adapter: see README.md, or use slurm-cpu.sh" >&2
    exit 3
fi
# shellcheck disable=SC2086 # the plane is several words
exec "$IMPACT_ATLAS" map $PLANE --data "$DATA" --part "$part" --backend gpu "${adapter[@]}"
