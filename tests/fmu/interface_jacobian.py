"""A master for one FMU and a mass on springs, in numpy: by plain exchange, and with the FMU's derivatives.

The FMU has the machine, with a force on a body as its input and the body's position as its output. Beside it a mass m is
tied to the body by springs of stiffness k, along x and y, and carries loads P(t). Over an exchange step from t to t + H the
FMU takes one force F on its body, and the mass moves under P - F:

    y' = y + v H + (1/m) integral of (t + H - s) (P(s) - F) ds,    v' = v + (1/m) integral of (P(s) - F) ds.

Plain exchange takes F = k (y - x) from the start of the step. The coupled step asks that F is the mean of the springs' force at
both ends,

    g(F) = F - k/2 ((y - x) + (y'(F) - x'(F))) = 0,    dg/dF = 1 + k/2 (H^2/(2 m) + dx'/dF),

x' what the FMU gives at the end of its step and dx'/dF its directional derivatives. Newton's method needs two steps of the
FMU, begun again from its state, for each exchange; derivatives are asked for again only where those of an earlier exchange do
not bring g down to a tenth."""

import numpy as np

NODES = np.sqrt(0.6) * np.array([-1, 0, 1])  # Gauss's rule for loads over a step
WEIGHTS = np.array([5, 8, 5]) / 18


class Mass:
    """The mass beside the FMU: its mass [kg], the springs [N/m], and loads(t) [N]."""

    def __init__(self, mass, stiffness, loads):
        self.mass, self.stiffness, self.loads = mass, stiffness, loads
        self.y, self.v = np.zeros(2), np.zeros(2)

    def end(self, t, step, force):
        """Position and velocity at t + step under a constant force of the springs."""
        ahead = step * (1 - NODES) / 2  # from the nodes to the end
        loads = [np.asarray(self.loads(t + step - left)) - force for left in ahead]
        push = step * sum(w * p for w, p in zip(WEIGHTS, loads))
        reach = step * sum(w * left * p for w, left, p in zip(WEIGHTS, ahead, loads))
        return self.y + step * self.v + reach / self.mass, self.v + push / self.mass


def set_force(instance, inputs, force):
    for name, value in zip(inputs, force):
        assert instance.set(name, value) == 0, instance.log


def position(instance, outputs):
    return np.array([instance.get(name) for name in outputs])


def exchange_plainly(instance, inputs, outputs, mass, step, count):
    """Positions of the body at the ends of `count` exchange steps."""
    start = position(instance, outputs)
    x, rows = np.zeros(2), []
    for k in range(count):
        force = mass.stiffness * (mass.y - x)
        set_force(instance, inputs, force)
        assert instance.step(k * step, step) == 0, instance.log
        mass.y, mass.v = mass.end(k * step, step, force)
        x = position(instance, outputs) - start
        rows.append(x)
    return np.array(rows)


def exchange_by_derivatives(instance, inputs, outputs, mass, step, count, tolerance=1e-3):
    """The same by coupled steps, solved until g is below `tolerance` [N]; steps that the FMU took, and how often its derivatives
    were asked for."""
    start = position(instance, outputs)
    x, rows, taken, asked, by_force = np.zeros(2), [], 0, 0, None
    springs = force = mass.stiffness * (mass.y - x)
    for k in range(count):
        state, last = instance.state(), np.inf
        while True:
            set_force(instance, inputs, force)
            assert instance.step(k * step, step) == 0, instance.log
            taken += 1
            x = position(instance, outputs) - start
            y, v = mass.end(k * step, step, force)
            residual = force - (springs + mass.stiffness * (y - x)) / 2
            size = np.abs(residual).max()
            if size < tolerance:
                break
            if by_force is None or size > last / 10:
                by_force, asked = np.array(instance.jacobian(outputs, inputs)), asked + 1
            last = size
            slope = np.eye(2) + mass.stiffness / 2 * (step**2 / (2 * mass.mass) * np.eye(2) + by_force)
            force = force - np.linalg.solve(slope, residual)
            instance.restore(state)
        instance.release(state)
        springs, mass.y, mass.v = mass.stiffness * (y - x), y, v
        rows.append(x)
    return np.array(rows), taken, asked
