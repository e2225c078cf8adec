#!/usr/bin/env bash
#SBATCH --job-name=impact-atlas
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=16
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=part-%a.log

# One part of the plane on the cores of one task:  sbatch --array=1-64 slurm-cpu.sh
set -euo pipefail
cd "${SLURM_SUBMIT_DIR:-.}"
source ./plane.sh
part=$SLURM_ARRAY_TASK_ID/${PARTS:-$SLURM_ARRAY_TASK_MAX}
# shellcheck disable=SC2086 # the plane is several words
exec "$IMPACT_ATLAS" map $PLANE --data "$DATA" --part "$part" --backend cpu --threads "${SLURM_CPUS_PER_TASK:-1}"
