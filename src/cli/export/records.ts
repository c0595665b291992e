/** What became of each take: the lines of the manifest. */

/** A file that is a part of another one. */
export interface PartHash {
  /** As listed: relative to the folder in which the command ran. */
  readonly path: string;
  readonly hash: string;
}

/** A take that was written. In the order of its line. */
export interface WrittenTake {
  /** As listed: relative to the folder in which the command ran. */
  readonly input: string;
  /** Hash of the input's bytes, SHA-256. */
  readonly hash: string;
  /** Other files that are in the input, such as the buffers of a `.gltf`; absent rather than empty. */
  readonly beside?: readonly PartHash[];
  /** Below the output folder. */
  readonly output: string;
  readonly bytes: number;
  readonly frames: number;
  readonly fps: number;
  readonly joints: number;
  /** What the review's checks found: `spike 1.233 LeftHand`; absent if it was not checked. */
  readonly flags?: readonly string[];
  /** What is wrong in the file, with what was used instead; absent rather than empty. */
  readonly warnings?: readonly string[];
  /** What the file doesn't state and was assumed in reading it: rate, unit, bones; absent rather than empty. */
  readonly notes?: readonly string[];
  /** Of the input, the options and the version: `--resume` skips what has the same. */
  readonly key: string;
  /** How long it took; the only part that differs from run to run. */
  readonly ms?: number;
}

/** An input of which nothing was written. */
export interface FailedTake {
  readonly input: string;
  readonly hash?: string;
  /** A sentence. */
  readonly error: string;
}

export type TakeRecord = WrittenTake | FailedTake;

export function isWritten(record: TakeRecord): record is WrittenTake {
  return 'output' in record;
}

/** A line of the manifest, with its end. */
export function lineOf(record: TakeRecord): string {
  return `${JSON.stringify(record)}\n`;
}

/** The records of a manifest; lines that a killed process left unfinished are none. */
export function recordsIn(text: string): readonly TakeRecord[] {
  return text.split('\n').flatMap((line): TakeRecord[] => {
    try {
      const record: unknown = JSON.parse(line);
      const isRecord = typeof record === 'object' && record !== null && 'input' in record;
      // What this program wrote; another's lines would fail the comparison of keys.
      return isRecord ? [record as TakeRecord] : [];
    } catch {
      return [];
    }
  });
}
