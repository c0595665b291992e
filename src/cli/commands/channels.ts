/** `marrow channels`: values and slopes of an animation's channels at given times, without skeleton or limits. */
import { flattened } from '../../edit/layers/flatten.ts';
import { compileTake } from '../../evaluate/compiled-take.ts';
import { evaluateChannel, evaluateSlope } from '../../evaluate/curves.ts';
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import { evaluateMotion, takeMotion } from '../../evaluate/take-motion.ts';
import { neighboursAt, tweened } from '../../evaluate/tween.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { keysOf, type Take } from '../../model/takes/take.ts';
import { TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { FILE_EXITS } from '../io.ts';
import { type Loaded, loadAny, openLoaded } from '../load.ts';
import { files } from '../options/inputs.ts';
import { KEEP_OPTION } from '../options/keep.ts';
import { number, numbers } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { printJson, report } from '../report.ts';
import { UsageError } from '../usage-error.ts';

export const channels = shellCommand({
  name: 'channels',
  summary: 'Prints the value of each channel of an animation at each time.',
  inputs: files('FILE.anim|BASE LAYER… NAME.layers.json [FILE.skel]', {
    'FILE.anim': 'An animation; no skeleton is needed, and no limits are enforced.',
    'BASE LAYER… NAME.layers.json': 'A take with layers, whose sum is printed.',
    'FILE.skel': 'The skeleton that the joints of layers belong to.',
  }),
  options: {
    times: option(numbers('T,T,…'), 'Evaluates the channels at these times, in seconds.', { isRequired: true }),
    tween: option(
      number('U'),
      'Adds to the JSON, for each channel and time, the value this share of the way from the key before to the key after, or null without both.',
    ),
    ...KEEP_OPTION,
    json: flag('Prints JSON, which adds the slopes at the times and the keys of each channel.'),
  },
  examples: ['marrow channels wasp_walk.anim --times -1,0,0.5 --json'],
  exits: FILE_EXITS,
  async run({ inputs, options: { times, json, tween, keep } }, io) {
    const loaded = await loadAny(inputs, io.folder, { keep });
    const layers = loaded.all.filter(({ kind }) => kind === 'layers');
    const isOne = loaded.all.length === 1 && loaded.all[0].kind === 'anim';
    if (!isOne && layers.length !== 1) {
      throw new UsageError('channels takes one .anim file, or one .layers.json with the files that it names.');
    }
    const { diagnostics } = loaded;
    report(diagnostics, io);
    const found = layers.length > 0 ? layeredTake(loaded) : plainTake(loaded);
    const values = found ? valuesAt(found, times) : [];
    if (json) {
      const tweens = found && tween !== undefined && { tween: tweensAt(found.take, times, tween) };
      await printJson({ channels: values, times, ...(found && curvesOf(found, times)), ...tweens, diagnostics }, io);
    } else await io.out(values.map((row, c) => `channel ${c}: ${row.join(' ')}\n`).join(''));
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

/** A take, with the skeleton that its layers are masked by. */
interface Found {
  readonly take: Take;
  readonly skeleton?: Skeleton;
}

function plainTake({ all: [{ content }] }: Loaded): Found | undefined {
  return content?.kind === 'anim' ? { take: content.take } : undefined;
}

/** Undefined if its files have errors. */
function layeredTake(loaded: Loaded): Found | undefined {
  const { characters } = openLoaded(loaded).document;
  const own = characters.flatMap(({ takes, skeleton }) =>
    takes.flatMap((take): Found[] => (take.layers ? [{ take, ...(skeleton && { skeleton }) }] : [])),
  );
  const [edited] = loaded.files.flatMap((file): Found[] => (file.kind === 'anim' ? [{ take: file.take }] : []));
  return own[0] ?? edited;
}

/** What JSON adds: slopes, and the keys, or those that flattening writes; null for channels that are fitted. */
function curvesOf(found: Found, times: readonly number[]) {
  const { take, skeleton } = found;
  const { take: plain, isFitted } = flattened(take, skeleton);
  return {
    slopes: slopesAt(plain, times),
    keys: plain.channels.map((_, c) => (isFitted[c] ? null : keysIn(plain, c))),
  };
}

function valuesAt({ take, skeleton }: Found, times: readonly number[]): number[][] {
  const motion = takeMotion(take, skeleton);
  const values = times.map((time) => {
    const row = new Float64Array(take.channels.length);
    // Samples of a take without layers are printed as they are.
    if (take.layers) evaluateMotion(motion, time, row, row.length);
    else for (let c = 0; c < row.length; c++) row[c] = evaluateChannel(motion.curves, c, time);
    return row;
  });
  return take.channels.map((_, c) => values.map((row) => row[c]));
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
