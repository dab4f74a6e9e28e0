# SPDX-License-Identifier: MIT
"""Telling people how far the work is."""

from __future__ import annotations

import sys
from typing import Any, Callable, Optional, Union

Report = Callable[[str, float], Optional[bool]]


class _Bar:
    """A bar of tqdm, where that is installed, or a line on stderr."""

    def __init__(self) -> None:
        self._bar: Any = None
        self._done = 0.0
        try:
            from tqdm.auto import tqdm  # type: ignore
        except ImportError:
            return
        self._bar = tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {elapsed}")

    def __call__(self, stage: str, fraction: float) -> None:
        percent = 100 * fraction
        if self._bar is None:
            sys.stderr.write(f"\r{stage:<9}{percent:5.1f} %")
            sys.stderr.flush()
            return
        self._bar.set_description(stage, refresh=False)
        self._bar.update(percent - self._done)
        self._done = percent

    def close(self) -> None:
        if self._bar is None:
            sys.stderr.write("\r" + " " * 20 + "\r")
        else:
            self._bar.update(100 - self._done)
            self._bar.close()


def run(progress: Union[None, bool, Report], work: Callable[[Any], Any]) -> Any:
    """work(report), with a bar where `progress` is True."""
    if progress is None or progress is False:
        return work(None)
    if progress is not True:
        if not callable(progress):
            raise TypeError("progress: True, or a function of stage and fraction, is wanted")
        return work(progress)
    bar = _Bar()
    try:
        return work(bar)
    finally:
        bar.close()
