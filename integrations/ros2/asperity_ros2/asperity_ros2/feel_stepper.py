"""Steps of Asperity's renderer by poses with times. Needs the Python package asperity."""
import asperity

LONGEST_GAP_S = 0.1  # a tip that was not seen for longer was lifted: it begins again


class FeelStepper:
    """The force on a tip at `position_m` in the scene's frame, one step a pose."""

    def __init__(self, scene, rate_hz=1000.0, settings=None):
        self._renderer = asperity.Renderer(asperity.read_scene(scene), rate_hz, settings or {})
        self._rate_hz = rate_hz
        self._last = None  # time and position

    def step(self, t_ns, position_m):
        """What the renderer gives (asperity.Touch). A time that does not rise, or a gap, begins again."""
        dt_s, velocity_mps = 1.0 / self._rate_hz, (0.0, 0.0, 0.0)
        if self._last is not None:
            passed_s = (t_ns - self._last[0]) * 1e-9
            if 0.0 < passed_s <= LONGEST_GAP_S:
                dt_s = passed_s
                velocity_mps = tuple((new - old) / dt_s for new, old in zip(position_m, self._last[1]))
            else:
                self._renderer.reset()
        self._last = t_ns, position_m
        return self._renderer.step(position_m, velocity_mps, dt_s)


def settings_of(texts):
    """{"friction": 0.2} of ["friction=0.2"]; numbers where they are numbers."""
    out = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name:
            raise SystemExit(f"'{text}' is not NAME=VALUE")
        try:
            out[name] = float(value)
        except ValueError:
            out[name] = value
    return out
