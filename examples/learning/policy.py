"""A driver that can learn: a network for the actions and one for the value, in numpy alone.

Both have two hidden layers of tanh. Actions are drawn around the first one's output, with a spread of their own for each
column; a driver that is not learning takes the output itself.
"""
import numpy as np


class Network:
    """Layers of tanh, the last one linear. Arrays are float32, one row for each sample."""

    def __init__(self, sizes, last_scale, rng):
        self.parameters = []
        for inputs, outputs in zip(sizes[:-1], sizes[1:]):
            is_last = len(self.parameters) == 2 * (len(sizes) - 2)
            weights = np.linalg.qr(rng.normal(size=(max(inputs, outputs), min(inputs, outputs))))[0]
            weights = weights if inputs >= outputs else weights.T
            self.parameters.append((weights * (last_scale if is_last else np.sqrt(2))).astype(np.float32))
            self.parameters.append(np.zeros(outputs, dtype=np.float32))

    def __call__(self, inputs):
        """The outputs, (N, outputs)."""
        return self.layers(inputs)[-1]

    def layers(self, inputs):
        """The inputs and what each layer gives."""
        found = [inputs]
        for number in range(0, len(self.parameters), 2):
            out = found[-1] @ self.parameters[number] + self.parameters[number + 1]
            found.append(out if number + 2 == len(self.parameters) else np.tanh(out))
        return found

    def gradients(self, layers, slope):
        """Of the parameters, from the loss's derivative by the outputs."""
        found = []
        for number in reversed(range(len(self.parameters) // 2)):
            found = [layers[number].T @ slope, slope.sum(axis=0)] + found
            if number:
                slope = (slope @ self.parameters[2 * number].T) * (1 - layers[number]**2)
        return found


class Policy:
    """Actor, critic and spread.

    Args:
        columns: of inputs.
        actions: of actions.
        rng: numpy.random.Generator of the first weights.
    """

    def __init__(self, columns, actions, rng, hidden=64):
        self.actor = Network((columns, hidden, hidden, actions), 0.01, rng)
        self.critic = Network((columns, hidden, hidden, 1), 1.0, rng)
        self.log_spread = np.full(actions, -1.2, dtype=np.float32)

    @property
    def parameters(self):
        """All arrays that are learned."""
        return self.actor.parameters + self.critic.parameters + [self.log_spread]

    def __call__(self, inputs):
        """Actions of a driver that does not try things out, (N, actions)."""
        return np.clip(self.actor(inputs), -1, 1)

    def draw(self, inputs, rng):
        """Actions that are tried, their log probabilities, and values."""
        mean = self.actor(inputs)
        noise = rng.standard_normal(mean.shape, dtype=np.float32)
        return mean + np.exp(self.log_spread) * noise, self.log_probability(noise), self.critic(inputs)[:, 0]

    def log_probability(self, noise):
        """Of actions that lie `noise` spreads from the mean, (N,)."""
        return -(0.5 * noise**2 + self.log_spread + 0.5 * np.log(2 * np.pi)).sum(axis=1)

    def save(self, path):
        """To a file of numpy."""
        np.savez_compressed(path, *self.parameters)

    def load(self, path):
        """What save() wrote."""
        with np.load(path) as file:
            for parameter, name in zip(self.parameters, file.files):
                parameter[...] = file[name]
        return self


class Adam:
    """Steps of Adam (Kingma and Ba, 2015), with the gradient's norm bounded."""

    def __init__(self, parameters, most_norm=0.5):
        self.parameters, self.most_norm, self.steps = parameters, most_norm, 0
        self.mean = [np.zeros_like(parameter) for parameter in parameters]
        self.square = [np.zeros_like(parameter) for parameter in parameters]

    def step(self, gradients, rate):
        """Moves the parameters against the gradients."""
        self.steps += 1
        norm = np.sqrt(sum(float((gradient**2).sum()) for gradient in gradients))
        scale = min(1.0, self.most_norm / (norm + 1e-8))
        rate *= np.sqrt(1 - 0.999**self.steps) / (1 - 0.9**self.steps)
        for parameter, gradient, mean, square in zip(self.parameters, gradients, self.mean, self.square):
            mean += 0.1 * (scale * gradient - mean)
            square += 0.001 * ((scale * gradient)**2 - square)
            parameter -= np.float32(rate) * mean / (np.sqrt(square) + 1e-5)
