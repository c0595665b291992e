/** `marrow channels`: values of an animation's channels at given times, without skeleton or limits. */
import { compileClip } from '../../evaluate/compiled-clip.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import type { ChannelClip } from '../../model/clip.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { numbersOf, parseArguments, UsageError } from '../arguments.ts';
import type { CliCommand } from '../io.ts';
import { loadFiles } from '../load.ts';
import { printJson, report } from '../report.ts';

export const channels: CliCommand = {
  name: 'channels',
  usage: 'FILE.anim --times t,t,… [--json]',
  summary: 'the value of each channel at each time',
  async run(args, io) {
    const given = parseArguments(args, { times: 'value', json: 'flag' });
    const text = given.value('times');
    if (text === undefined) throw new UsageError('--times is missing: --times t,t,…');
    const times = numbersOf('times', text);
    const { all, diagnostics } = loadFiles(given.files, io.folder);
    if (all.length !== 1 || all[0].kind !== 'anim') throw new UsageError('channels takes one .anim file.');
    report(diagnostics, io);
    const { content } = all[0];
    const values = content?.kind === 'anim' ? valuesAt(content.clip, times) : [];
    if (given.flag('json')) await printJson({ channels: values, times, diagnostics }, io);
    else await io.out(values.map((row, c) => `channel ${c}: ${row.join(' ')}\n`).join(''));
    return hasErrors(diagnostics) ? 1 : 0;
  },
};

function valuesAt(clip: ChannelClip, times: readonly number[]): number[][] {
  const compiled = compileClip(clip);
  return clip.channels.map((_, c) => times.map((time) => evaluateChannel(compiled, c, time)));
}
