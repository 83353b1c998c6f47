#!/usr/bin/env python3
"""Times PyTorch and Stable-Baselines3 on the work that `ltl-rover bench` times, one core, one line of JSON for each.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install -r benches/peers/requirements.txt
    /tmp/peers/bin/python benches/peers/peers.py

Set the numbers beside those of `ltl-rover bench` run on the same machine. Not part of any test: the packages are large.
"""

import argparse
import copy
import json
import statistics
import time

import torch
from torch import nn

OBSERVATION, ACTION, REPLAY = 8, 2, 10_000
SIZES = [(64, 64), (128, 128), (256, 128)]


def network(inputs, outputs, hidden, last):
    layers = [nn.Linear(inputs, hidden), nn.ReLU(), nn.Linear(hidden, hidden), nn.ReLU(), nn.Linear(hidden, outputs), last]
    return nn.Sequential(*layers)


class Update:
    """A DDPG update: batch, targets, critic, actor, soft updates; Adam with its epsilon of 1e-8."""

    def __init__(self, hidden, rows):
        self.rows = rows
        self.actor = network(OBSERVATION, ACTION, hidden, nn.Tanh())
        self.critic = network(OBSERVATION + ACTION, 1, hidden, nn.Identity())
        self.actor_target, self.critic_target = copy.deepcopy(self.actor), copy.deepcopy(self.critic)
        self.actor_adam = torch.optim.Adam(self.actor.parameters(), lr=1e-4, fused=True)
        self.critic_adam = torch.optim.Adam(self.critic.parameters(), lr=1e-3, fused=True)
        self.samples = [torch.rand(REPLAY, n) * 2 - 1 for n in (OBSERVATION, ACTION, 1, OBSERVATION)]
        self.pairs = [
            (list(target.parameters()), list(own.parameters()))
            for target, own in [(self.actor_target, self.actor), (self.critic_target, self.critic)]
        ]

    def __call__(self):
        index = torch.randint(REPLAY, (self.rows,))
        observation, action, reward, following = (numbers[index] for numbers in self.samples)
        with torch.no_grad():
            value = self.critic_target(torch.cat([following, self.actor_target(following)], 1))
            target = reward + 0.99 * value
        loss = nn.functional.mse_loss(self.critic(torch.cat([observation, action], 1)), target)
        self.critic_adam.zero_grad()
        loss.backward()
        self.critic_adam.step()
        loss = -self.critic(torch.cat([observation, self.actor(observation)], 1)).mean()
        self.actor_adam.zero_grad()
        loss.backward()
        self.actor_adam.step()
        with torch.no_grad():
            for target, own in self.pairs:
                torch._foreach_lerp_(target, own, 1e-3)


def seconds(work, count):
    start = time.perf_counter()
    for _ in range(count):
        work()
    return (time.perf_counter() - start) / count


def pytorch(rounds):
    works = {size: Update(*size) for size in SIZES}
    times = {size: [] for size in SIZES}
    for work in works.values():
        seconds(work, 50)
    for _ in range(rounds):
        for size, work in works.items():
            times[size].append(seconds(work, 50))
    for (hidden, rows), all_rounds in times.items():
        result = {"median_us": 1e6 * statistics.median(all_rounds), "best_us": 1e6 * min(all_rounds)}
        print(json.dumps({"contender": f"PyTorch {torch.__version__}", "what": "update", "hidden": hidden, "rows": rows, **result}))


def stable_baselines(steps):
    import gymnasium
    import stable_baselines3

    settings = {"net_arch": [64, 64]}
    environment = gymnasium.make("Pendulum-v1")
    learner = stable_baselines3.DDPG("MlpPolicy", environment, batch_size=64, learning_starts=100, train_freq=1, policy_kwargs=settings)
    learner.learn(200)
    taken = seconds(lambda: learner.learn(steps, reset_num_timesteps=False), 1)
    name = f"Stable-Baselines3 {stable_baselines3.__version__} DDPG, Pendulum"
    print(json.dumps({"contender": name, "what": "step", "steps_per_s": steps / taken}))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Times PyTorch and Stable-Baselines3.")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--steps", type=int, default=2000)
    arguments = parser.parse_args()
    torch.set_num_threads(1)
    pytorch(arguments.rounds)
    stable_baselines(arguments.steps)
