"""Textures and meshes of scenes/library/showcase; tests/tools/make_showcase.py writes them.

`textures` holds the pictures, `mesh` the writer of OBJ files, `fittings` what several buildings
have, `people` the figures. Each building has a module of its own.
"""
