/** Names for new joints: the next in a series, and that of the other side. */
import { readName } from '../../evaluate/retarget/names.ts';
import { trailingDigitsAt } from '../../model/names/numbered-names.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/** More are no number that can be counted on. */
const MAX_DIGITS = 9;

/** The name itself if unused; else with the next free number: `spine2` after `spine1`. */
export function freeName(taken: ReadonlySet<string>, name: string, separator = '_'): string {
  if (!taken.has(name)) return name;
  const at = trailingDigitsAt(name, MAX_DIGITS);
  const [stem, digits] = [name.slice(0, at), name.slice(at)];
  for (let n = digits ? Number(digits) + 1 : 2; ; n++) {
    const next = digits ? stem + String(n).padStart(digits.length, '0') : `${stem}${separator}${n}`;
    if (!taken.has(next)) return next;
  }
}

/** Default name of a child: its parent's with the next number, or `joint3`. */
export function childName({ joints }: Skeleton, parent: number): string {
  const taken = new Set(joints.map(({ name }) => name));
  const above = joints[parent].name;
  return /\D\d+$/.test(above) ? freeName(taken, above) : freeName(taken, `joint${joints.length}`);
}

const SWAPPED: Readonly<Record<string, string>> = {
  left: 'right',
  right: 'left',
  l: 'r',
  r: 'l',
  lft: 'rgt',
  rgt: 'lft',
};

/**
 * The name of the other side: `hip_l` → `hip_r`, `LeftUpLeg` → `RightUpLeg`, `L_Arm` → `R_Arm`, `arm.L` → `arm.R`,
 * `lfemur` → `rfemur`. A side is a separate word, delimited by a capital, a digit or a non-letter, or attached to a
 * part of the body that retargeting knows. Undefined if the name has no side.
 */
export function mirroredName(name: string): string | undefined {
  // Prefixes before a colon are the same for all joints.
  const prefix = name.slice(0, name.lastIndexOf(':') + 1);
  const own = name.slice(prefix.length);
  let isSided = false;
  const swapped = own.replace(/\p{Lu}?\p{Ll}+|\p{Lu}+(?!\p{Ll})/gu, (word) => {
    const other = SWAPPED[word.toLowerCase()];
    if (!other) return word;
    isSided = true;
    return asWritten(other, word);
  });
  if (isSided) return prefix + swapped;
  const { side } = readName(own);
  const glued = side === 'middle' ? undefined : /^(left|right|l|r)(.+)$/is.exec(own);
  return glued ? prefix + asWritten(SWAPPED[glued[1].toLowerCase()], glued[1]) + glued[2] : undefined;
}

/** With the capitalisation of the word that it replaces. */
function asWritten(word: string, model: string): string {
  if (model === model.toLowerCase()) return word;
  if (model === model.toUpperCase()) return word.toUpperCase();
  return word.charAt(0).toUpperCase() + word.slice(1);
}
