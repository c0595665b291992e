/** `marrow convert IN… OUT.glb` and its like: one character with its takes, for other programs. */
import { resolve } from 'node:path';
import { CommandError } from '../edit/command-error.ts';
import { notLeading } from '../edit/follow/leaders.ts';
import { spaceText } from '../evaluate/space/space.ts';
import { EXCHANGES, writeExchange } from '../export/exchange.ts';
import { EXCHANGE_FORMATS, type ExchangeFormat } from '../export/formats.ts';
import { DEFAULT_GLB, type GlbOptions } from '../export/glb/options.ts';
import { diagnosticsOf } from '../export/shared/report.ts';
import { TakeError } from '../export/shared/take-motion.ts';
import { openFiles } from '../files/open/open-files.ts';
import { refusal } from '../files/save/conversion.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { type Character, type Document, EMPTY_DOCUMENT } from '../model/document.ts';
import { byPath, type ParsedFile } from '../model/files.ts';
import type { PickOptions } from './convert-one.ts';
import { oneOf, text, whole } from './options/kinds.ts';
import { flag, type OptionValues, option, section } from './options/option.ts';
import { UsageError } from './usage-error.ts';
import { writeOutput } from './write-output.ts';

/** Options of `convert` for files of other programs only. */
export const EXCHANGE_OPTIONS = section(`Only for an output that ends in ${listed(EXCHANGE_FORMATS)}`, {
  keys: option(
    oneOf(['linear', 'cubic']),
    'Interpolates keys of a `.glb` by straight lines, the default, or by cubic splines, which are fewer but which Blender takes for straight lines.',
  ),
  influences: option(whole('N', 1), 'Keeps at most this many attachments per vertex, the strongest, instead of all.'),
  take: option(text('NAME', 'the name of a take'), 'Writes only the take of this name instead of all.'),
  'no-body': flag('Leaves out the boxes and bones that a character without a skin is shown by in a `.glb`.'),
  raw: flag(
    "Keeps the file's own unit, axes and origin instead of metres and y up; a `.fbx` always does, and states them.",
  ),
});
export type ExchangeOptionValues = OptionValues<typeof EXCHANGE_OPTIONS>;

/** `.glb, .fbx or .vrma`. */
function listed(formats: readonly ExchangeFormat[]): string {
  const ends = formats.map((format) => `.${format}`);
  return ends.length < 2 ? ends.join('') : `${ends.slice(0, -1).join(', ')} or ${ends.at(-1)}`;
}

type OptionName = keyof typeof EXCHANGE_OPTIONS;

function counts(option: OptionName, format: ExchangeFormat): boolean {
  return !EXCHANGES[format].ignores.includes(option === 'no-body' ? 'body' : option);
}

/**
 * Refuses options that mean nothing in what is written.
 * @param format undefined if it is none of other programs
 * @throws UsageError
 */
export function refuseOptions(format: ExchangeFormat | undefined, given: ExchangeOptionValues): void {
  // The keys of a literal are its own.
  for (const option of Object.keys(EXCHANGE_OPTIONS) as OptionName[]) {
    const isGiven = given[option] !== undefined && given[option] !== false;
    if (!isGiven || (format && counts(option, format))) continue;
    const ends = listed(EXCHANGE_FORMATS.filter((each) => counts(option, each)));
    throw new UsageError(`--${option} is for ${ends} files; the output must end in ${ends}.`);
  }
}

export interface WrittenExchange {
  readonly bytes: number;
  readonly diagnostics: readonly Diagnostic[];
}

/** @param out relative to the folder */
export async function convertToExchange(
  { format, given }: { readonly format: ExchangeFormat; readonly given: ExchangeOptionValues },
  files: readonly ParsedFile[],
  out: string,
  folder: string,
  { edit, ...common }: PickOptions,
): Promise<WrittenExchange> {
  const options = readOptions(given, common);
  const name = out.slice(Math.max(out.lastIndexOf('/'), out.lastIndexOf('\\')) + 1);
  const failed = (code: string, message: string) => ({ bytes: 0, diagnostics: [refusal(code, message, name)] });
  const { document, diagnostics } = openFiles(EMPTY_DOCUMENT, files, [], undefined, byPath);
  const { characters } = document;
  const whole = notLeading(characters.filter(({ skeleton, skins }) => skeleton || skins.length > 0));
  if (whole.length === 0) {
    const held = files.map(({ source }) => source.path).join(', ') || 'nothing';
    return failed('part-missing', `Expected a skeleton or a skin for ${name}, found ${held}.`);
  }
  const left = leftOut(document, whole);
  if (left.length > 0) return { bytes: 0, diagnostics: [...diagnostics, ...left] };
  if (whole.length > 1) {
    const names = whole.map((character) => character.name).join(', ');
    return failed(
      'part-ambiguous',
      `Expected one character for ${name}, found ${whole.length} (${names}). Name only one, or write each: --to ${format} --out DIR.${edit ? '' : ' To put the motion of one on another, name the files of the other by --retarget, one each.'}`,
    );
  }
  try {
    const [character] = whole;
    const edited = edit ? edit(character) : character;
    const written = await write({ format, options, isRaw: given.raw }, edited, name, resolve(folder, out));
    return { ...written, diagnostics: [...diagnostics, ...written.diagnostics] };
  } catch (error) {
    if (!(error instanceof TakeError || error instanceof CommandError)) throw error;
    return failed('conversion-refused', error.message);
  }
}

/** Parts that would not be in the file although they were given. */
function leftOut({ characters, unused }: Document, whole: readonly Character[]): readonly Diagnostic[] {
  const takes = notLeading(characters)
    .filter((character) => !whole.includes(character))
    .flatMap(({ sources }) => sources);
  const parts = unused.filter(({ file }) => file.kind === 'skin' || file.kind === 'morph' || file.kind === 'anim');
  return [
    ...takes.map(({ path }) =>
      refusal('part-unused', `It belongs to none of ${whole.length} characters. Name it after one.`, path),
    ),
    ...parts.map(({ file, why }) => refusal('part-unused', why, file.source.path)),
  ];
}

interface Asked {
  readonly format: ExchangeFormat;
  readonly options: GlbOptions;
  /** Whether the file's own unit, axes and origin are kept, rather than glTF's metres and y up. */
  readonly isRaw: boolean;
}

async function write(
  { format, options, isRaw }: Asked,
  character: Character,
  name: string,
  path: string,
): Promise<WrittenExchange> {
  const { pieces, report } = await writeExchange(format, character, options, !isRaw);
  const written = writeOutput(path, pieces);
  if ('bytes' in written) {
    return {
      bytes: written.bytes,
      diagnostics: [...(isRaw ? [] : spaceTold(format, character, name)), ...diagnosticsOf(report, name)],
    };
  }
  const message = `The file could not be written: ${written.failure}.`;
  return { bytes: 0, diagnostics: [refusal('file-not-written', message, name)] };
}

function spaceTold(format: ExchangeFormat, { space }: Character, name: string): readonly Diagnostic[] {
  if (space?.known !== 'guessed') return [];
  const written = format === 'fbx' ? 'which the file states' : 'and is written in metres; --raw keeps its numbers';
  const message = `The input is guessed to be in ${spaceText(space)}, ${written}.`;
  return [withoutPlace('info', 'space-guessed', message, name)];
}

function readOptions(
  { keys, influences, take, 'no-body': isBare }: ExchangeOptionValues,
  { framesPerSecond, tolerance }: { readonly framesPerSecond?: number; readonly tolerance?: number },
): GlbOptions {
  return {
    ...DEFAULT_GLB,
    ...(keys !== undefined && { keys }),
    body: !isBare,
    ...(framesPerSecond !== undefined && { framesPerSecond }),
    ...(tolerance !== undefined && { tolerance }),
    ...(influences !== undefined && { influences }),
    ...(take !== undefined && { take }),
  };
}
