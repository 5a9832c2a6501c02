"""What every recorder of this folder simulates: five bricks that fall on a floor, z up.

Each number is one that float32 holds exactly, so that an engine in float64 starts where the scene does.
"""
import broadside

DT_S, FRAMES, COUNT, MASS_KG, FRICTION, GRAVITY_M_S2 = 1 / 256, 384, 5, 2.0, 1.0, -9.8125
HALF_M = (0.25, 0.1875, 0.125)
PLACES_M = [(k / 16, 0.0, 0.375 + k / 2) for k in range(COUNT)]
DENSITY_KG_M3 = MASS_KG / (8 * HALF_M[0] * HALF_M[1] * HALF_M[2])
FLOOR = 0xFFFFFFF4  # the face -z of the domain, as body B of a point


def scene():
    """The scene; its floor is the lower face of the domain, and its other faces are far away."""
    surface = {"mu_static": FRICTION, "mu_kinetic": FRICTION, "restitution": 0.0}
    made = broadside.SceneBuilder(name="bricks", frames=FRAMES, dt_s=DT_S, motion="rigid",
                                  gravity_m_s2=[0, 0, GRAVITY_M_S2])
    made.domain(min_m=[-9, -9, 0], max_m=[9, 9, 9]).material(**surface).face_material(**surface)
    made.mesh("brick", shape="box", sides_m=[2 * h for h in HALF_M])
    for place in PLACES_M:
        made.body(position_m=place, mass_kg=MASS_KG)
    return made.build()
