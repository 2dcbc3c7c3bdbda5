"""A PyElastica rod with the generated law in place of its linear one.

The simulator keeps its kinematics, its balance laws and its time stepper. Each step the strains it
has found go into `rod.loads`, and the loads come back as the stress and couple that its linear
functions would have given: with unit stiffness matrices those are strain minus rest strain, so the
rest strain is what sets them. A chiral rod, clamped at one end and pulled at the other, stretches
and twists until it rests; the closed-form state says where. Needs the extra `elastica`.
"""

import elastica as ea
import numpy as np
from elastica.memory_block import MemoryBlockCosseratRod

from rodproof.generated.equilibria import states
from rodproof.generated.scenes import full_rod as rod

MODULI = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3, "p": 3.3}
C = rod.Constants(**MODULI)


class LimitedRod(ea.CosseratRod):
    """A rod whose law is the generated one."""


class LimitedBlock(MemoryBlockCosseratRod):
    """The simulator's store of such rods (here: one), which computes their internal loads."""

    def compute_internal_forces_and_torques(self, time):
        """Strains by PyElastica, loads by the generated law, balance by PyElastica."""
        super().compute_internal_forces_and_torques(time)  # for the strains at this place
        u, v = self.kappa, self.sigma + np.array([[0.0], [0.0], [1.0]])
        # n at the elements, then m at the nodes between them, each with the other's mean strains
        flexure = np.concatenate([u[:, :1], (u[:, 1:] + u[:, :-1]) / 2, u[:, -1:], u], axis=1)
        stretch = np.concatenate([v, (v[:, 1:] + v[:, :-1]) / 2], axis=1)
        m, n = rod.loads(flexure, stretch, C)
        elements = v.shape[1]
        self.rest_sigma[:] = self.sigma - n[:, :elements] * self.dilatation
        self.rest_kappa[:] = self.kappa - m[:, elements:] * self.voronoi_dilatation**3
        super().compute_internal_forces_and_torques(time)


class Simulator(ea.BaseSystemCollection, ea.Constraints, ea.Forcing, ea.Damping):
    """What this simulation needs."""


def pull(tension, elements=8, time=8.0, dt=1e-3):
    """The rod of length 1 at rest under the tension: its dilatation v3 and twist u3."""
    simulator = Simulator()
    simulator.enable_block_supports(LimitedRod, LimitedBlock)
    e3 = np.array([0.0, 0.0, 1.0])
    made = LimitedRod.straight_rod(
        elements, np.zeros(3), e3, np.array([1.0, 0.0, 0.0]), 1.0, 0.3, 3.5,
        youngs_modulus=1.0, shear_modulus=1.0,
    )  # fmt: skip
    made.shear_matrix[:] = np.eye(3)[:, :, None]
    made.bend_matrix[:] = np.eye(3)[:, :, None]
    simulator.append(made)
    simulator.constrain(made).using(
        ea.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    simulator.add_forcing_to(made).using(
        ea.EndpointForces, np.zeros(3), tension * e3, ramp_up_time=1.0
    )
    simulator.dampen(made).using(
        ea.AnalyticalLinearDamper, uniform_damping_constant=7.0, time_step=dt
    )
    simulator.finalize()
    stepper, now = ea.PositionVerlet(), 0.0
    for _ in range(round(time / dt)):
        now = stepper.step(simulator, now, dt)
    return made.sigma[2] + 1, made.kappa[2]


if __name__ == "__main__":
    print("tension  v3 simulated    v3 closed form  u3 simulated   u3 closed form  linear v3")
    for tension in (0.5, 4.0):
        v3, u3 = pull(tension)
        closed = states.straight(tension, states.Constants(**MODULI))
        linear = 1 + tension * C.per_eta**2 * C.per_gap / C.gamma
        print(
            f"{tension:7} {v3.mean():.12f}  {closed.v[2]:.12f}  {u3.mean():+.10f}"
            f"  {closed.u[2]:+.10f}   {linear:.4f}"
        )
        assert np.abs(v3 - closed.v[2]).max() < 1e-9
        assert np.abs(u3 - closed.u[2]).max() < 1e-9
