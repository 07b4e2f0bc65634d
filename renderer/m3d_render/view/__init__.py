"""A scene as things that stand in space, to walk around: the `m3d-view` command.

`bodies`, `ground`, `marks`, `fan` and `viewpoint` work out what is seen, as plain arrays in the scene's coordinates;
`description` says what a thing is. `stage` puts all of it before a camera, and `window` lets people handle it while
`follower` looks after the file. Only `stage` and `window` need pyvista, which comes with `mirage3d[view]`.
"""
