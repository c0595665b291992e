import { expect, it } from 'vitest';
import { MOUSE_AREAS, type MouseArea, mouseHints } from '../../../../src/ui/shell/help/mouse-hints.ts';
import { POSING_MODES } from '../../../../src/ui/state/posing.ts';

const whats = (...args: Parameters<typeof mouseHints>) => mouseHints(...args).map(([what]) => what);

it('every area says what the mouse does, in every mode', () => {
  for (const area of Object.keys(MOUSE_AREAS) as MouseArea[]) {
    for (const mode of POSING_MODES) expect(mouseHints({ area, cursor: '', mode }).length).toBeGreaterThan(1);
  }
});

it('over a joint a click does what the mode does', () => {
  const at = { area: 'viewport', cursor: '', joint: 'knee' } as const;
  expect(whats({ ...at, mode: 'fk' })).toEqual(['Rotate or move knee', 'Select knee', 'Add or remove', 'Orbit']);
  expect(whats({ ...at, mode: 'select' })).toContain('Select knee');
  expect(whats({ ...at, mode: 'ik' })).toContain('Pin knee');
  expect(whats({ ...at, mode: 'rig' })).toContain('Move knee');
  expect(whats({ ...at, mode: 'rig', isAdding: true })).toEqual(['Add a joint', 'Without the grid', 'Finish']);
});

it('the ball within the rings and the margin of a ring are handles too', () => {
  const at = { area: 'viewport', cursor: 'move' } as const;
  expect(whats({ ...at, mode: 'fk' })).toContain('Rotate or move');
  expect(whats({ ...at, mode: 'ik' })).toContain('Rotate or move');
});

it('a pin is moved by a drag, and a click selects it in Pose mode and removes it in IK mode', () => {
  const at = { area: 'viewport', cursor: 'grab', isPin: true } as const;
  expect(whats({ ...at, mode: 'pose' })).toEqual(['Move the pin', 'In depth', 'Select it']);
  expect(whats({ ...at, mode: 'ik' })).toEqual(['Move the pin', 'In depth', 'Remove it', 'Select it']);
});

it('a handle of the tool comes before the joint behind it', () => {
  expect(whats({ area: 'viewport', cursor: 'grab', joint: 'knee', mode: 'fk' })).toContain('Rotate or move');
});

it('over a key the mouse moves it, beside it selects by a box', () => {
  expect(whats({ area: 'curves', cursor: 'move', mode: 'fk' })).toContain('Move selected keys');
  expect(whats({ area: 'curves', cursor: 'default', mode: 'fk' })).toContain('Box select');
});

it('the scrubber and the rulers say what Shift does to snapping now', () => {
  const places = [
    { area: 'scrubber', cursor: '' },
    { area: 'curves', cursor: 'col-resize' },
    { area: 'dope', cursor: 'col-resize' },
  ] as const;
  for (const place of places) {
    expect(whats({ ...place, mode: 'fk', snapsToFrames: true })).toContain('Without snapping to frames');
    expect(whats({ ...place, mode: 'fk', snapsToFrames: false })).toContain('Snapping to frames');
  }
});

it('over a handle of the scrubber a drag moves it, and beside it the time', () => {
  expect(whats({ area: 'scrubber', cursor: 'ew-resize', mode: 'fk' })[0]).toContain('end of the range');
  expect(whats({ area: 'scrubber', cursor: '', mode: 'fk' })[0]).toBe('Change the current time');
});

it('the wheel is said to do the same over curves and the dope sheet', () => {
  const wheel = (area: MouseArea) => mouseHints({ area, cursor: '', mode: 'fk' }).filter(([, how]) => how === 'wheel');
  expect(wheel('curves')).toEqual([['Zoom', 'wheel']]);
  for (const area of ['dope', 'scrubber'] as const) expect(wheel(area)).toEqual(wheel('curves'));
});
