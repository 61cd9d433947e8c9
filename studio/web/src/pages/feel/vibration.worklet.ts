// In the audio thread: forces at the servo's rate become sound.
import { softened, VibrationReader } from "./vibrationReader";

declare const sampleRate: number;
declare class AudioWorkletProcessor {
  readonly port: MessagePort;
}
declare function registerProcessor(name: string, processor: new () => AudioWorkletProcessor): void;

const kCeiling = 0.8;
const kBuffer_s = 0.04;
const kFullScale_N = 0.5;

interface Piece {
  samples_N?: Float32Array;
  rate_Hz?: number;
  volume?: number;
}

class Vibration extends AudioWorkletProcessor {
  private reader: VibrationReader | null = null;
  private rate_Hz = 0;
  private volume = 0;

  constructor() {
    super();
    this.port.onmessage = (message: MessageEvent<Piece>) => this.take(message.data);
  }

  process(_inputs: Float32Array[][], outputs: Float32Array[][]): boolean {
    const channels = outputs[0] ?? [];
    const first = channels[0];
    if (!first) return true;
    if (this.reader) {
      this.reader.read(first);
      const factor = this.volume / kFullScale_N;
      for (let index = 0; index < first.length; ++index) first[index] = softened(factor * first[index]!, kCeiling);
    }
    for (const other of channels.slice(1)) other.set(first);
    return true;
  }

  private take({ samples_N, rate_Hz, volume }: Piece): void {
    if (volume !== undefined) this.volume = volume;
    if (!samples_N || !rate_Hz) return;
    if (rate_Hz !== this.rate_Hz) {
      this.rate_Hz = rate_Hz;
      this.reader = new VibrationReader({ inputRate_Hz: rate_Hz, outputRate_Hz: sampleRate, buffer_s: kBuffer_s });
    }
    this.reader!.push(samples_N);
  }
}

registerProcessor("vibration", Vibration);
