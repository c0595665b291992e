/** `marrow channels`: values and slopes of an animation's channels at given times, without skeleton or limits. */
import { compileClip } from '../../evaluate/compiled-clip.ts';
import { evaluateChannel, evaluateSlope } from '../../evaluate/curves.ts';
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { type ChannelClip, keysOf, TANGENT_KINDS } from '../../model/takes/clip.ts';
import { FILE_EXITS } from '../io.ts';
import { loadAny } from '../load.ts';
import { files } from '../options/inputs.ts';
import { numbers } from '../options/kinds.ts';
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
    json: flag('Prints JSON, which adds the slopes at the times and the keys of each channel.'),
  },
  examples: ['marrow channels wasp_walk.anim --times -1,0,0.5 --json'],
  exits: FILE_EXITS,
  async run({ inputs, options: { times, json } }, io) {
    const { all, diagnostics } = await loadAny(inputs, io.folder);
    if (all.length !== 1 || all[0].kind !== 'anim') throw new UsageError('channels takes one .anim file.');
    report(diagnostics, io);
    const { content } = all[0];
    const clip = content?.kind === 'anim' ? content.clip : undefined;
    const values = clip ? valuesAt(clip, times) : [];
    if (json) {
      const curves = clip && { slopes: slopesAt(clip, times), keys: clip.channels.map((_, c) => keysIn(clip, c)) };
      await printJson({ channels: values, times, ...curves, diagnostics }, io);
    } else await io.out(values.map((row, c) => `channel ${c}: ${row.join(' ')}\n`).join(''));
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

function valuesAt(clip: ChannelClip, times: readonly number[]): number[][] {
  const compiled = compileClip(clip);
  return clip.channels.map((_, c) => times.map((time) => evaluateChannel(compiled, c, time)));
}

/** In value per second, on the side after the time. */
function slopesAt(clip: ChannelClip, times: readonly number[]): number[][] {
  const compiled = compileClip(clip);
  return clip.channels.map((_, c) => times.map((time) => evaluateSlope(compiled, c, time, 'out')));
}

/** The keys of a channel with the slopes that their tangents come to. */
function keysIn(clip: ChannelClip, channel: number) {
  const keys = keysOf(clip.channels[channel]);
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
