/**
 * `tx ry`, typed: the DOFs of a compound joint.
 * @param choices what there is, each at most once
 * @returns the list, or what is wrong with it
 */
export function typedList(text: string, choices: readonly string[]): readonly string[] | string {
  const words = text
    .toLowerCase()
    .split(/[\s,]+/)
    .filter(Boolean);
  const list: string[] = [];
  for (const word of words) {
    if (!choices.includes(word)) return `“${word.slice(0, 12)}” is none of ${choices.join(' ')}.`;
    if (list.includes(word)) return `${word} is listed twice; a compound joint has each DOF once at most.`;
    list.push(word);
  }
  return list.length ? list : 'A compound joint has at least one DOF: what it had stays.';
}
