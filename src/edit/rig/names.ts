/** Names of joints that are made: of the next one in a row, and of the one on the other side. */
import { readName } from '../../evaluate/retarget/names.ts';
import type { Skeleton } from '../../model/skeleton.ts';

/** The name itself where no joint has it; else with the next number that none has: `spine2` after `spine1`. */
export function freeName(taken: ReadonlySet<string>, name: string, separator = '_'): string {
  if (!taken.has(name)) return name;
  const [, stem, digits] = /^(.*?)(\d*)$/s.exec(name) ?? [name, name, ''];
  for (let n = digits ? Number(digits) + 1 : 2; ; n++) {
    const next = digits ? stem + String(n).padStart(digits.length, '0') : `${stem}${separator}${n}`;
    if (!taken.has(next)) return next;
  }
}

/** What a joint below another is called that nobody named: with the next number of that one's, or `joint3`. */
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
 * The name for the other side: `hip_l` → `hip_r`, `LeftUpLeg` → `RightUpLeg`, `L_Arm` → `R_Arm`, `arm.L` → `arm.R`,
 * `lfemur` → `rfemur`. A side is a word of its own, set off by a capital, a digit or whatever is no letter, or glued to a
 * part of the body that retargeting knows. Undefined where the name says no side.
 */
export function mirroredName(name: string): string | undefined {
  // What programs put before a colon is the same for all joints.
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

/** In capitals, with one, or without, as the word in whose place it stands. */
function asWritten(word: string, model: string): string {
  if (model === model.toLowerCase()) return word;
  if (model === model.toUpperCase()) return word.toUpperCase();
  return word.charAt(0).toUpperCase() + word.slice(1);
}
