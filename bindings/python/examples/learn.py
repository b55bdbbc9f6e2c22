"""A short training: robots learn to go to their goals, with the filter below them from the first step on.

All robots share one linear policy: where to go is a matrix times what a robot sees. It is found by evolution strategies (antithetic
noise, the plain gradient estimate), with numpy alone. Whatever the policy tries while it learns, no law of the controller is broken.

    python bindings/python/examples/learn.py [GENERATIONS]

prints what robots earn before and after, and writes learn.svg.
"""

from __future__ import annotations

import sys

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

import closeranks as cr
from closeranks.learning import Episode

PAIRS, NOISE, RATE = 8, 0.05, 0.05
SCENARIO = cr.Scenario(duration_s=4.0, controller={"kind": "budget"})
Policy = npt.NDArray[np.float64]


class Trial:
    """Plays episodes, and counts the laws that were broken in any of them."""

    def __init__(self) -> None:
        self.episode = Episode(SCENARIO, ticks_per_step=40)
        self.broken = 0

    def earned(self, policy: Policy, seed: int) -> float:
        """Metres by which robots came nearer to their goals, in the mean."""
        seen, over, total = self.episode.begin(seed), False, 0.0
        while not over:
            seen, earned, over = self.episode.act(seen @ policy)
            total += float(earned.mean())
        self.broken += sum(law.expected for law in self.episode.world.violations)
        return total


def learn(trial: Trial, generations: int) -> tuple[Policy, list[float]]:
    """The policy after so many generations, and what it earned in each."""
    random = np.random.default_rng(0)
    policy, history = np.zeros((trial.episode.size, 2)), []
    for generation in range(generations):
        noise = random.normal(size=(PAIRS, *policy.shape))
        ends = [
            (trial.earned(policy + NOISE * step, generation), trial.earned(policy - NOISE * step, generation))
            for step in noise
        ]
        gains = np.array([up - down for up, down in ends])
        gradient = np.tensordot(gains, noise, axes=1)
        policy = policy + RATE * gradient / (np.linalg.norm(gradient) + 1e-12) * np.sqrt(policy.size)
        history.append(float(np.mean(ends)))
    return policy, history


def main(generations: int) -> None:
    """Trains, tests on episodes that were not trained on, and draws."""
    trial = Trial()
    straight = np.zeros((trial.episode.size, 2))
    straight[:2] = np.eye(2)
    policy, history = learn(trial, generations)
    fresh = range(1000, 1010)
    at_rest, after, best = (
        float(np.mean([trial.earned(one, seed) for seed in fresh])) for one in (np.zeros_like(policy), policy, straight)
    )
    print(f"on ten new episodes: at rest {at_rest:+.3f} m, after {generations} generations {after:+.3f} m, straight to the goal {best:+.3f} m")
    print(f"laws broken in {2 * PAIRS * generations + 30} episodes: {trial.broken}")
    figure, axes = plt.subplots(figsize=(5, 3), layout="constrained")
    axes.plot(history, label="while learning")
    axes.axhline(best, color="tab:grey", linewidth=0.8, label="straight to the goal, new episodes")
    axes.plot([generations - 1], [after], "o", label="learned, new episodes")
    axes.set_xlabel("generation")
    axes.set_ylabel("metres nearer to the goal")
    axes.legend(fontsize="small")
    figure.savefig("learn.svg", metadata={"Date": None})


if __name__ == "__main__":
    plt.switch_backend("agg")
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 60)
