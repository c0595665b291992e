import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { NameSprites } from '../../../src/view/names/name-sprites.ts';

/** What is drawn on the canvas of the sprites, and copied from it, in order. */
let said: string[];
/** Opacity of each copy. */
let opacities: number[];

/** As far as it is used here; letters are 10 pixels wide. */
const atlasPen = {
  setTransform: () => undefined,
  clearRect: () => said.push('clear'),
  strokeText: () => undefined,
  fillText: (text: string) => said.push(`write ${text}`),
  measureText: (text: string) => ({ width: 10 * text.length }),
};
const target = {
  globalAlpha: 1,
  drawImage: (...[, x, y, , , toX, toY]: number[]) => {
    said.push(`copy ${x},${y} to ${toX},${toY}`);
    opacities.push(target.globalAlpha);
  },
};

function sprites(): NameSprites {
  const made = new NameSprites(target as unknown as CanvasRenderingContext2D);
  said.length = 0;
  return made;
}

describe('sprites of names', () => {
  beforeEach(() => {
    [said, opacities] = [[], []];
    target.globalAlpha = 1;
    vi.stubGlobal('document', { createElement: () => ({ width: 0, height: 0, getContext: () => atlasPen }) });
  });
  afterEach(() => {
    vi.unstubAllGlobals();
  });

  it('are all written before any is copied, each with its opacity, and none twice', () => {
    const made = sprites();
    const [a, b] = [made.name('a'), made.name('bb')];
    made.draw(a, 'red', 100, 50, 1);
    made.draw(b, 'red', 200, 50, 0.45);
    made.draw(a, 'red', 300, 50, 1);
    expect(said).toEqual(['write a', 'write bb']);
    made.flush();
    expect(said.slice(2)).toEqual(['copy 0,0 to 96,40', 'copy 18,0 to 196,40', 'copy 0,0 to 296,40']);
    expect(opacities).toEqual([1, 0.45, 1]);
    expect(target.globalAlpha).toBe(1);
    made.flush();
    made.draw(b, 'red', 200, 50, 1);
    made.flush();
    expect(said.slice(5)).toEqual(['copy 18,0 to 196,40']);
  });

  it('are copied before their canvas is cleared for others, and when many wait', () => {
    const made = sprites();
    const long = (i: number) => `${i}`.padEnd(90, 'x');
    for (let i = 0; i < 200; i++) made.draw(made.name(long(i)), 'red', 0, 0, 1);
    made.flush();
    expect(said.filter((one) => one.startsWith('copy'))).toHaveLength(200);
    expect(said.filter((one) => one.startsWith('write'))).toHaveLength(200);
    // What was written since the last clearing is copied, and no more, before the next one.
    let waiting = 0;
    for (const one of said) {
      if (one.startsWith('write')) waiting++;
      else if (one.startsWith('copy')) waiting--;
      else expect(waiting).toBe(0);
    }
    expect(said.filter((one) => one === 'clear').length).toBeGreaterThan(2);
  });
});
