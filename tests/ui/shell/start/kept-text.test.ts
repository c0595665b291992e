import { describe, expect, it } from 'vitest';
import { contentText, whenText } from '../../../../src/ui/shell/start/kept-text.ts';

describe('work that was left behind, in words', () => {
  it('tells one character’s joints and takes', () => {
    expect(contentText([{ name: 'wasp', joints: 31, takes: 2 }])).toBe('wasp, 31 joints, 2 takes');
    expect(contentText([{ name: 'wasp', joints: 1, takes: 0 }])).toBe('wasp, 1 joint');
  });

  it('names two of several, and counts the others', () => {
    const named = (name: string) => ({ name, joints: 3, takes: 1 });
    expect(contentText(['a', 'b'].map(named))).toBe('a and b');
    expect(contentText(['a', 'b', 'c'].map(named))).toBe('a, b and 1 more character');
  });

  it('work that was left behind, in words has a word for files that belong to nobody', () => {
    expect(contentText([])).toBe('files without a character');
  });

  it('tells the time of today, and the day of what is older', () => {
    const now = new Date(2026, 2, 3, 9, 0);
    const time = (date: Date) => date.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' });
    const today = new Date(2026, 2, 3, 8, 15);
    const yesterday = new Date(2026, 2, 2, 23, 59);
    const before = new Date(2026, 1, 28, 14, 32);
    expect(whenText(today.getTime(), now)).toBe(time(today));
    expect(whenText(yesterday.getTime(), now)).toBe(`yesterday, ${time(yesterday)}`);
    expect(whenText(before.getTime(), now)).toBe(`28 February, ${time(before)}`);
  });
});
