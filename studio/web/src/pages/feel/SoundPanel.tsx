import { useEffect, useRef, useState } from "preact/hooks";
import { Panel } from "../../ui/Panel";
import { Slider } from "../../ui/Slider";
import { attempt } from "../../ui/Button";
import { Toggle } from "../../ui/Toggle";
import { openSound, type Sound } from "./sound";

const kVolume = 0.4;

/** The vibration heard; off at first, for it needs a user's word, and belongs to this window alone. */
export function SoundPanel() {
  const [on, setOn] = useState(false);
  const [volume, setVolume] = useState(kVolume);
  const sound = useRef<Sound | null>(null);
  const wanted = useRef(false);

  const close = () => {
    sound.current?.close();
    sound.current = null;
  };
  useEffect(
    () => () => {
      wanted.current = false;
      close();
    },
    [],
  );
  const turn = (next: boolean) => {
    wanted.current = next;
    setOn(next);
    if (!next) return close();
    void attempt(async () => {
      try {
        const opened = await openSound(volume);
        if (wanted.current && !sound.current) sound.current = opened;
        else opened.close();
      } catch (error) {
        wanted.current = false;
        setOn(false);
        throw error;
      }
    });
  };
  return (
    <Panel title="Sound">
      <Toggle label="Play the vibration" on={on} hint="The force above 30 Hz, as the motion of a voice coil." onChange={turn} testId="feel-sound" />
      <Slider
        label="Volume"
        value={volume}
        low={0}
        high={1}
        step={0.01}
        factor={100}
        unit="%"
        disabled={!on}
        onInput={(next) => {
          setVolume(next);
          sound.current?.setVolume(next);
        }}
        testId="feel-volume"
      />
    </Panel>
  );
}
