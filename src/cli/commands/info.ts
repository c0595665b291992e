/** `marrow info`: what files contain, their problems, and which of them belong together. */

import { factsOf } from '../../files/kinds.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import type { Character, Document } from '../../model/document.ts';
import { arePoints } from '../../model/skeleton/joint-types.ts';
import { FILE_EXITS } from '../io.ts';
import { type LoadedFile, loadAny, nothingRead, openLoaded, withoutSkeleton } from '../load.ts';
import { ANY_FILE, files } from '../options/inputs.ts';
import { KEEP_OPTION } from '../options/keep.ts';
import { flag } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { printJson, report } from '../report.ts';

export const info = shellCommand({
  name: 'info',
  summary: 'Shows what files contain, their problems, and which files belong together.',
  inputs: files('FILE…', { FILE: ANY_FILE }),
  options: { ...KEEP_OPTION, json: flag('Prints files, characters and problems as JSON.') },
  examples: ['marrow info wasp.skel wasp.skin'],
  exits: FILE_EXITS,
  async run({ inputs, options: { json, keep } }, io) {
    const loaded = await loadAny(inputs, io.folder, { keep });
    const opened = openLoaded(loaded);
    const diagnostics = [
      ...opened.diagnostics,
      ...withoutSkeleton(opened.document.characters),
      // A folder counts by its content.
      ...nothingRead(loaded, inputs),
    ];
    report(diagnostics, io);
    const described = loaded.all.map(describeFile);
    if (json) {
      const { document } = opened;
      const unused = document.unused.map(({ file, why }) => ({ name: file.source.path, why }));
      await printJson(
        { files: described, characters: document.characters.map(describeCharacter), unused, diagnostics },
        io,
      );
    } else if (described.length > 0) await io.out(asText(described, opened.document));
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

interface FileFacts {
  /** With folders: a class hands in many files of one name. */
  readonly name: string;
  readonly kind: string;
  readonly loaded: boolean;
  readonly [count: string]: unknown;
}

function describeFile({ path, kind, content }: LoadedFile): FileFacts {
  return { name: path, kind, loaded: content !== undefined, ...(content && factsOf(content)) };
}

function describeCharacter({ name, skeleton, skins, morphs, takes, sources }: Character) {
  return {
    name,
    joints: arePoints(skeleton) ? 0 : (skeleton?.joints.length ?? 0),
    ...(arePoints(skeleton) && { points: skeleton?.joints.length }),
    skins: skins.map((s) => s.name),
    morphs: morphs.map((m) => m.name),
    takes: takes.map((c) => c.name),
    files: sources.map((s) => s.path),
  };
}

/** Records in a list are counted before they are told. */
const MAX_RECORDS = 3;

/** `1 (time 1.5, rows 92, numbers 368)` of a list of records. */
function factText(value: unknown): string {
  if (!Array.isArray(value)) return String(value);
  const records = value.filter((each) => typeof each === 'object' && each !== null);
  if (records.length === 0) return value.join(' ');
  const told = records.slice(0, MAX_RECORDS).map((record) =>
    Object.entries(record)
      .map(([key, each]) => `${key} ${factText(each)}`)
      .join(', '),
  );
  return `${records.length} (${told.join('; ')}${records.length > told.length ? '; …' : ''})`;
}

/** `bee/wasp.skel   skel   joints 19, dofs 57, roots 1`, then the characters and files left unused. */
function asText(files: readonly FileFacts[], { characters, unused }: Document): string {
  const width = Math.max(...files.map((f) => f.name.length));
  const lines = files.map(({ name, kind, loaded, ...rest }) => {
    const facts = Object.entries(rest).map(([key, value]) => `${key} ${factText(value)}`);
    const text = loaded ? facts.join(', ') : 'not loaded';
    return `${name.padEnd(width)}  ${kind.padEnd(7)}  ${text}`;
  });
  for (const { name, sources } of characters) {
    lines.push(`character ${name}: ${sources.map((source) => source.path).join(', ')}`);
  }
  for (const { file, why } of unused) lines.push(`unused ${file.source.path}: ${why}`);
  return `${lines.join('\n')}\n`;
}
