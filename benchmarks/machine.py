"""The machine that was measured on."""

import datetime
import os
import platform
import shutil
import subprocess
from pathlib import Path


def machine() -> dict[str, object]:
    """Processor, cores, memory, compilers, Python, date."""
    return {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "system": f"{platform.system()} {platform.machine()}",
        "processor": _processor(),
        "vectors": _vectors(),
        "cores": os.cpu_count() or 1,
        "memory_gb": _memory(),
        "python": platform.python_version(),
        "gcc": version("gcc"),
        "clang": version("clang"),
    }


def version(program: str) -> str | None:
    """First line of `program --version`; None without it."""
    if shutil.which(program) is None:
        return None
    said = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    return said.stdout.partition("\n")[0] or None


def _fact(name: str) -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return ""
    return next((line.partition(":")[2].strip() for line in lines if line.startswith(name)), "")


def _processor() -> str:
    return _fact("model name") or platform.processor() or "unknown"


def _vectors() -> str:
    flags = set(_fact("flags").split())
    known = [("avx512f", "AVX-512"), ("avx2", "AVX2"), ("sse2", "SSE2")]
    return next((name for flag, name in known if flag in flags), "unknown")


def _memory() -> float | None:
    try:
        return round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9, 1)
    except (ValueError, OSError):
        return None
