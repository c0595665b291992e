/**
 * Encodes ids for the picking render: every joint, bone and skin vertex that can be picked has a number, drawn as a
 * colour. Numbers are assigned in runs (one for the joints, one per skin); 0 is "nothing".
 *
 *     colour = (id & 255, id >> 8 & 255, id >> 16 & 255, id >> 24) / 255        little end first
 */
export interface IdRun<T> {
  /** First id of the run. */
  readonly first: number;
  readonly count: number;
  readonly what: T;
}

/** Assigns ids 1, 2, 3 …, at most 2³² − 1 of them. */
export class IdRuns<T> {
  private readonly runs: IdRun<T>[] = [];
  private next = 1;

  /** Assigns `count` ids to `what` and returns the first. */
  add(count: number, what: T): number {
    const first = this.next;
    this.runs.push({ first, count, what });
    this.next += count;
    return first;
  }

  clear(): void {
    this.runs.length = 0;
    this.next = 1;
  }

  find(id: number): IdRun<T> | undefined {
    return this.runs.find((run) => id >= run.first && id < run.first + run.count);
  }
}

/** The id of pixel `index` of RGBA bytes. */
export function decodeId(pixels: ArrayLike<number>, index: number): number {
  const i = 4 * index;
  // Multiplied, since shifting the last byte could make the number negative.
  return pixels[i] + (pixels[i + 1] << 8) + (pixels[i + 2] << 16) + pixels[i + 3] * 0x1000000;
}

/**
 * The id nearest to the centre of a square image, within `reach` pixels, that `accepts` takes; 0 for none. Ties are
 * resolved in a fixed order: the lower row, then the further left.
 */
export function nearestId(
  pixels: ArrayLike<number>,
  size: number,
  reach: number,
  accepts: (id: number) => boolean,
): number {
  const centre = (size - 1) / 2;
  let best = 0;
  let bestDistance = reach * reach + 1e-9;
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) {
      const distance = (x - centre) ** 2 + (y - centre) ** 2;
      if (distance > bestDistance || (best !== 0 && distance === bestDistance)) continue;
      const id = decodeId(pixels, y * size + x);
      if (id === 0 || !accepts(id)) continue;
      best = id;
      bestDistance = distance;
    }
  }
  return best;
}
