/** `marrow channels`: values and slopes of an animation's channels at given times, without skeleton or limits. */
import { compileTake } from '../../evaluate/compiled-take.ts';
import { evaluateChannel, evaluateSlope } from '../../evaluate/curves.ts';
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import { neighboursAt, tweened } from '../../evaluate/tween.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { keysOf, type Take } from '../../model/takes/take.ts';
import { TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { FILE_EXITS } from '../io.ts';
import { loadAny } from '../load.ts';
import { files } from '../options/inputs.ts';
import { number, numbers } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { printJson, report } from '../report.ts';
import { UsageError } from '../usage-error.ts';

export const channels = shellCommand({
  name: 'channels',
  summary: 'Prints the value of each channel of an animation at each time.',
  inputs: files('FILE.anim', { 'FILE.anim': 'An animation; no skeleton is needed, and no limits are enforced.' }),
  options: {
    times: option(numbers('T,T,…'), 'Evaluates the channels at these times, in seconds.', { isRequired: true }),
    tween: option(
      number('U'),
      'Adds to the JSON, for each channel and time, the value this share of the way from the key before to the key after, or null without both.',
    ),
    json: flag('Prints JSON, which adds the slopes at the times and the keys of each channel.'),
  },
  examples: ['marrow channels wasp_walk.anim --times -1,0,0.5 --json'],
  exits: FILE_EXITS,
  async run({ inputs, options: { times, json, tween } }, io) {
    const { all, diagnostics } = await loadAny(inputs, io.folder);
    if (all.length !== 1 || all[0].kind !== 'anim') throw new UsageError('channels takes one .anim file.');
    report(diagnostics, io);
    const { content } = all[0];
    const take = content?.kind === 'anim' ? content.take : undefined;
    const values = take ? valuesAt(take, times) : [];
    if (json) {
      const tweens = take && tween !== undefined && { tween: tweensAt(take, times, tween) };
      const curves = take && { slopes: slopesAt(take, times), keys: take.channels.map((_, c) => keysIn(take, c)) };
      await printJson({ channels: values, times, ...curves, ...tweens, diagnostics }, io);
    } else await io.out(values.map((row, c) => `channel ${c}: ${row.join(' ')}\n`).join(''));
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

function valuesAt(take: Take, times: readonly number[]): number[][] {
  const compiled = compileTake(take);
  return take.channels.map((_, c) => times.map((time) => evaluateChannel(compiled, c, time)));
}

/** Null where a channel has no key on both sides of a time. */
function tweensAt(take: Take, times: readonly number[], share: number): (number | null)[][] {
  return take.channels.map((channel) =>
    times.map((time) => {
      const near = channel.kind === 'keys' ? neighboursAt(channel, time) : undefined;
      return near ? tweened(near, share) : null;
    }),
  );
}

/** In value per second, on the side after the time. */
function slopesAt(take: Take, times: readonly number[]): number[][] {
  const compiled = compileTake(take);
  return take.channels.map((_, c) => times.map((time) => evaluateSlope(compiled, c, time, 'out')));
}

/** The keys of a channel with the slopes that their tangents come to. */
function keysIn(take: Take, channel: number) {
  const keys = keysOf(take.channels[channel]);
  const slopes = resolvedSlopes(keys);
  return Array.from(keys.times, (time, k) => ({
    time,
    value: keys.values[k],
    slopeIn: slopes.in[k],
    slopeOut: slopes.out[k],
    tangentIn: TANGENT_KINDS[keys.tangentsIn.kinds[k]],
    tangentOut: TANGENT_KINDS[keys.tangentsOut.kinds[k]],
  }));
}
