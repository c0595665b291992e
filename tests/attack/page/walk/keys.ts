/** Keys as the browser's protocol wants them, by the names that pages see. */
export interface ProtocolKey {
  readonly key: string;
  readonly code: string;
  readonly windowsVirtualKeyCode: number;
  /** What it types; absent for keys that type nothing. */
  readonly text?: string;
}

const NAMED: Readonly<Record<string, readonly [code: number, text?: string]>> = {
  Backspace: [8],
  Tab: [9],
  Enter: [13, '\r'],
  Escape: [27],
  PageUp: [33],
  PageDown: [34],
  End: [35],
  Home: [36],
  ArrowLeft: [37],
  ArrowUp: [38],
  ArrowRight: [39],
  ArrowDown: [40],
  Delete: [46],
  F1: [112],
  F2: [113],
  F3: [114],
  F6: [117],
  F10: [121],
};

/** Of a keyboard for English. */
const SIGNS: Readonly<Record<string, readonly [code: string, virtual: number, shifted: string]>> = {
  ',': ['Comma', 188, '<'],
  '.': ['Period', 190, '>'],
  '[': ['BracketLeft', 219, '{'],
  ']': ['BracketRight', 221, '}'],
  '/': ['Slash', 191, '?'],
  '-': ['Minus', 189, '_'],
  '=': ['Equal', 187, '+'],
  '\\': ['Backslash', 220, '|'],
  ' ': ['Space', 32, ' '],
};

/** Every key that a walk presses. */
export const KEYS: readonly string[] = [
  ...'abcdefghijklmnopqrstuvwxyz0123456789',
  ...Object.keys(SIGNS),
  ...Object.keys(NAMED),
];

/** @param name one of `KEYS` */
export function keyOf(name: string, isShifted: boolean): ProtocolKey {
  if (Object.hasOwn(NAMED, name)) {
    const [windowsVirtualKeyCode, text] = NAMED[name];
    return { key: name, code: name, windowsVirtualKeyCode, ...(text !== undefined && { text }) };
  }
  if (Object.hasOwn(SIGNS, name)) {
    const [code, windowsVirtualKeyCode, shifted] = SIGNS[name];
    const key = isShifted ? shifted : name;
    return { key, code, windowsVirtualKeyCode, text: key };
  }
  const upper = name.toUpperCase();
  const isDigit = /^\d$/.test(name);
  const key = isShifted ? (isDigit ? ')!@#$%^&*('[Number(name)] : upper) : name;
  return { key, code: isDigit ? `Digit${name}` : `Key${upper}`, windowsVirtualKeyCode: upper.charCodeAt(0), text: key };
}
