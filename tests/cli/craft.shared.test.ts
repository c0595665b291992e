/** Auto tangents and tweens on the command line, against the reference's numbers. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, expect, it } from 'vitest';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { command, commandJson } from '../helpers/command.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

interface Craft {
  readonly kinds: readonly { readonly anim: string; readonly kinds: readonly (readonly [string, string])[][] }[];
  readonly derive: readonly { readonly anim: string; readonly slopes: readonly (readonly number[])[] }[];
  readonly tween: readonly TweenCase[];
}
interface TweenCase {
  readonly anim: string;
  readonly u: number;
  readonly times: readonly number[];
  readonly values: readonly (readonly (number | null)[])[];
}
interface KeysJson {
  readonly keys: readonly {
    readonly time: number;
    readonly value: number;
    readonly slopeIn: number;
    readonly slopeOut: number;
    readonly tangentIn: string;
    readonly tangentOut: string;
  }[][];
}

describeShared('auto tangents and tweens of the reference files', () => {
  const craft = conformance<Craft>('craft.json');
  const folder = mkdtempSync(join(tmpdir(), 'marrow-craft-'));
  afterAll(() => rmSync(folder, { recursive: true }));
  const keysOf = (file: string) => commandJson<KeysJson>(['channels', file, '--times', '0', '--json'], sharedPath(''));

  it.each(craft.kinds)('$anim has the reference’s kinds of tangents', async ({ anim, kinds }) => {
    const { keys } = await keysOf(anim);
    expect(keys.map((own) => own.map((key) => [key.tangentIn, key.tangentOut]))).toEqual(kinds);
  });

  it.each(craft.derive)(
    '$anim gets the reference’s slopes, and is read with them as auto',
    async ({ anim, slopes }) => {
      const out = join(folder, 'out.anim');
      const { code } = await command(['convert', anim, out, '--tangents', 'auto'], sharedPath(''));
      expect(code).toBe(0);
      const { keys } = await keysOf(out);
      expect(keys.map((own) => own.length)).toEqual(slopes.map((own) => own.length));
      for (const side of ['slopeIn', 'slopeOut'] as const) {
        expectClose(
          keys.flat().map((key) => key[side]),
          slopes.flat(),
          WITHIN.reference,
          side,
        );
      }
      expect(new Set(keys.flat().flatMap((key) => [key.tangentIn, key.tangentOut]))).toEqual(new Set(['auto']));
      const again = join(folder, 'again.anim');
      await command(['convert', out, again], sharedPath(''));
      expect(readFileSync(again, 'utf8')).toBe(readFileSync(out, 'utf8'));
    },
  );

  it.each(['smooth', 'linear', 'flat'])('all keys become %s', async (kind) => {
    const out = join(folder, `${kind}.anim`);
    expect((await command(['convert', 'data/craft/auto.anim', out, '--tangents', kind], sharedPath(''))).code).toBe(0);
    const { keys } = await keysOf(out);
    expect(new Set(keys.flat().flatMap((key) => [key.tangentIn, key.tangentOut]))).toEqual(new Set([kind]));
  });

  it.each(craft.tween)('$anim has the reference’s tween by $u', async ({ anim, u, times, values }) => {
    const args = ['channels', anim, '--times', times.join(','), '--tween', String(u), '--json'];
    const { tween } = await commandJson<{ readonly tween: (number | null)[][] }>(args, sharedPath(''));
    expect(tween.map((row) => row.map((value) => value === null))).toEqual(
      values.map((row) => row.map((value) => value === null)),
    );
    const numbers = (rows: readonly (readonly (number | null)[])[]) => rows.flat().filter((value) => value !== null);
    expectClose(numbers(tween), numbers(values), WITHIN.reference, 'tween');
  });

  it('another word is refused, and so is more than one output', async () => {
    const wrong = await command(['convert', 'data/craft/auto.anim', 'x.anim', '--tangents', 'soft'], sharedPath(''));
    expect([wrong.code, wrong.err]).toEqual([2, expect.stringContaining('smooth, auto, linear, flat')]);
    const many = await command(
      ['convert', 'data/craft/auto.anim', '--to', 'rig', '--tangents', 'auto'],
      sharedPath(''),
    );
    expect([many.code, many.err]).toEqual([2, expect.stringContaining('--tangents')]);
  });
});
