"""Figures of a scene's air: the temperature profile, the fan of rays from the eye, the transfer characteristic.

    import m3dc
    from matplotlib.figure import Figure
    from m3d_render import plot

    scene = m3dc.compile(source).ir
    fan = plot.ray_fan(scene, angles_rad)          # plain arrays, in SI units and radians
    axes = Figure().subplots()
    plot.draw_fan(fan, axes)

What each figure shows is worked out by one function and drawn by another. Only drawing needs matplotlib, which comes
with `mirage3d[plot]`.
"""

from m3d_render.geometry import ViewPlane
from m3d_render.plot.profile import TemperatureProfile, draw_profile, temperature_profile
from m3d_render.plot.rays import RayFan, draw_fan, ray_fan
from m3d_render.plot.section import Cut, section
from m3d_render.plot.transfer import Transfer, Zone, draw_transfer, transfer_characteristic
from m3d_render.sight import things_distance, view_angles

__all__ = [
    "Cut",
    "RayFan",
    "TemperatureProfile",
    "Transfer",
    "ViewPlane",
    "Zone",
    "draw_fan",
    "draw_profile",
    "draw_transfer",
    "ray_fan",
    "section",
    "temperature_profile",
    "things_distance",
    "transfer_characteristic",
    "view_angles",
]
