# SPDX-License-Identifier: MIT
"""Closed surfaces from stacks of planar contours, exact and valid."""
