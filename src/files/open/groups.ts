/** Opening the files of a skeleton: a character, or one for each root. */
import { checkSkin } from '../../evaluate/skin/binding.ts';
import type { Steps } from '../../evaluate/steps.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { type BrokenFile, type ParsedFile, stemOf, type WholeCharacter } from '../../model/files.ts';
import { firstTake } from '../../model/takes/moving.ts';
import { withUnread, withWhole } from './assemble.ts';
import { charactersIn, partOpening, withFile } from './contents.ts';
import { type FileGroup, isBroken, isRead, prefixFit } from './grouping.ts';
import type { Opening } from './opening.ts';
import { settle } from './settle.ts';

/** The files that a character is opened from. */
interface CharacterFiles {
  /** Name of a new character. */
  readonly name: string;
  /** Its skeleton; absent for a skin that a rig names without one. */
  readonly own: { readonly file: ParsedFile; readonly whole: WholeCharacter } | undefined;
  /** Rigs, skeleton and parts. */
  readonly files: readonly ParsedFile[];
  /** Parts with errors. */
  readonly broken: readonly BrokenFile[];
}

/** Opens the characters of a group, in a step for each of their files; all wait if the skeleton has errors. */
export function* openGroup(opening: Opening, group: FileGroup): Steps<void> {
  const { characters } = opening;
  const { skeleton, rigs, parts } = group;
  const broken = parts.filter(isBroken);
  const rest = [...rigs, ...parts].filter(isRead);
  const skeletonFile = skeleton && isRead(skeleton) ? skeleton : undefined;
  // The skeleton, or all that a rig names.
  const missing = skeletonFile ? undefined : (skeleton ?? (rest.length === rigs.length ? broken[0] : undefined));
  if (missing) {
    for (const file of rest) opening.wait(file, missing.source);
    return;
  }
  const files = [...rigs, ...(skeleton ? [skeleton] : []), ...parts].filter(isRead);
  const wholes = skeletonFile ? charactersIn(skeletonFile) : [undefined];
  const earlier = skeletonFile ? characters.withFile(skeletonFile.source) : [];
  for (const [root, whole] of wholes.entries()) {
    const before = earlier[root] ?? (whole && root === 0 ? withoutSkeletonFor(opening, group, whole) : undefined);
    const name = group.name ?? whole?.skeleton.name ?? stemOf(files[0].source);
    const own = skeletonFile && whole ? { file: skeletonFile, whole } : undefined;
    // Several roots become several characters; the other files of the group belong to the first.
    if (root === 0) yield* assemble(opening, { name, own, files, broken }, before);
    else yield* assemble(opening, { name, own, files: skeletonFile ? [skeletonFile] : [], broken: [] }, before);
  }
  // The file has fewer roots than before.
  const gone = new Set(earlier.slice(wholes.length));
  if (gone.size) characters.replaceAll(characters.all.filter((c) => !gone.has(c)));
}

/** Opens a character with those of its files that fit. */
function* assemble(
  opening: Opening,
  { name, own, files, broken }: CharacterFiles,
  before: Character | undefined,
): Steps<void> {
  const start = before ?? opening.make(name);
  const unread: BrokenFile[] = [...broken];
  let left = files;
  for (;;) {
    const skin = unread.find(({ kind }) => kind === 'skin');
    const skins = [before, own?.whole].flatMap((from) => from?.skins ?? []);
    if (skin && skins.length === 0 && !left.some(({ kind }) => kind === 'skin')) {
      const waiting = left.filter((file) => partOpening(file)?.onSkin);
      for (const file of waiting) opening.wait(file, skin.source);
      unread.push(...waiting);
      left = left.filter((file) => !waiting.includes(file));
    }
    // One that waited for a skeleton was named after its take or skin.
    const called = start.skeleton ? start : { ...start, name };
    const next = yield* assembled(opening, called, left, own, before);
    const sources = unread.map(({ source }) => source);
    const misfits = settle(opening, before, withUnread(next, sources), left);
    if (misfits.length === 0) break;
    unread.push(...misfits);
    left = left.filter((file) => !misfits.includes(file));
  }
  for (const { source } of opening.opened.has(start.id) ? broken : []) {
    const message = `"${start.skeleton ? start.name : name}" is opened without it.`;
    opening.tell('info', 'opened-without', message, source);
  }
}

function* assembled(
  { spaces, used, files: all }: Opening,
  start: Character,
  files: readonly ParsedFile[],
  own: CharacterFiles['own'],
  before: Character | undefined,
): Steps<Character> {
  let next = start;
  if (own) {
    const { file, whole } = own;
    next = withWhole(next, whole, { ...file, before }, before?.space ?? spaces.of(whole));
  }
  for (const file of files) {
    next = withFile(next, file, before);
    yield Math.min(1, used.size / all.length);
  }
  // Of several new alternatives, show the first.
  return before ? next : { ...next, shownSkin: 0, shownTake: firstTake(next.takes) };
}

/** A character without a skeleton that this group completes: matched by name, or the only one waiting. */
function withoutSkeletonFor(
  { base, opened, characters }: Opening,
  group: FileGroup,
  { skeleton }: WholeCharacter,
): Character | undefined {
  const fits = ({ skins }: Character) => skins.every((skin) => !hasErrors(checkSkin(skin, skeleton, '')));
  const bare = base.characters.filter((c) => !c.skeleton && !opened.has(c.id));
  const waiting = bare.flatMap((c) => characters.current(c) ?? []).filter(fits);
  const stem = group.skeleton ? stemOf(group.skeleton.source) : '';
  const byName = waiting.find((c) => c.sources.some((s) => prefixFit(stem, stemOf(s)) > 0));
  // A group with its own skin or animation is complete and takes no other character's.
  return byName ?? (waiting.length === 1 && group.parts.length === 0 ? waiting[0] : undefined);
}
