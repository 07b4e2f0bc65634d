"""Mirage3D as a whole: one distribution that brings all others, and the command `mirage3d`.

`versions` says what is installed. The compiler is the package `m3dc`, the renderer `m3d_render`.
"""
