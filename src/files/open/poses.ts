/** Adding a pose file to a character's library. */
import { takePose } from '../../edit/pose/by-names.ts';
import { addPoses, withPoses } from '../../edit/pose/library.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { type FileNaming, type ParsedFile, type SourceFile, sameName } from '../../model/files.ts';
import { NO_MARKS, readAs, UNMARKED } from '../../model/part.ts';
import { formatKindOf, KINDS } from '../kinds.ts';

/** A pose file that was read. */
export type PoseFile = Extract<ParsedFile, { readonly kind: 'pose' }>;

/** The fraction of a file's joints that a character must have. */
const FITS = 0.5;

/** The first of the characters with the most joints of these poses; undefined if none has enough. */
export function fittingCharacter({ poses }: PoseFile, characters: readonly Character[]): Character | undefined {
  let best: Character | undefined;
  let most = FITS;
  for (const character of characters) {
    let found = 0;
    let all = 0;
    for (const pose of poses) {
      const taken = takePose(character, pose);
      found += taken.found;
      all += pose.joints.length;
      // Poses of a face may contain morphs only.
      if (pose.joints.length === 0) {
        all++;
        if (taken.values.size > 0) found++;
      }
    }
    const share = all > 0 ? found / all : 0;
    if (best ? share <= most : share < most) continue;
    best = character;
    most = share;
  }
  return best;
}

/**
 * Adds the file's poses to the character and reports what does not fit. If all its poses came from a file of that name,
 * the new ones replace them.
 */
export function givePoses(character: Character, { poses, source }: PoseFile, called: FileNaming) {
  const diagnostics: Diagnostic[] = [];
  const missing = new Set(poses.flatMap((pose) => takePose(character, pose).missing));
  if (missing.size > 0) {
    const [first] = missing;
    const others = missing.size > 1 ? ` and ${missing.size - 1} more` : '';
    const message = `${character.name} has no joint "${first}"${others} for the poses.`;
    diagnostics.push(withoutPlace('warning', 'pose-joint-missing', message, called(source), 'left out'));
  }
  const { poses: mark, ...marks } = character.parts ?? NO_MARKS;
  const isThis = (own: SourceFile) => sameName(own.name, source.name);
  const isReadAgain = mark?.file !== undefined && isThis(mark.file.source);
  const next = addPoses(isReadAgain ? withPoses(character, []) : character, poses);
  const sources = [...character.sources.filter((own) => !isThis(own)), source];
  // A library from several files has no file of its own.
  const isOfOthers =
    mark !== undefined && !isReadAgain && (mark.file !== undefined || sources.some((s) => !isThis(s) && holdsPoses(s)));
  const read = isOfOthers
    ? { ...UNMARKED, id: mark.id }
    : readAs(mark, { kind: 'pose', source, holds: character.name });
  return { character: { ...next, sources, parts: { ...marks, poses: read } }, diagnostics };
}

function holdsPoses({ name }: SourceFile): boolean {
  const format = formatKindOf(name);
  return format !== undefined && KINDS[format].content === 'pose';
}
