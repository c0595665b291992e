/** What a page offers to be clicked, dragged and typed into: looked at now and then, since mere chance rarely hits it. */
import type { Page } from 'playwright-core';

export interface Control {
  readonly kind: 'item' | 'button' | 'field' | 'row' | 'canvas';
  /** CSS pixels. */
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Items that end the walk, or what it shows: undo with less memory no longer leads back to the beginning. */
const NOT = 'install|new version|memory for undo|automatic \\(|^\\d+ (MB|GB)|print';

/** All that is visible, in the order of the document; of an open menu or dialog, only what it has. */
export function controlsOf(page: Page): Promise<readonly Control[]> {
  return page.evaluate((not) => {
    const ends = new RegExp(not, 'i');
    const kinds = {
      item: '[role=menu] [role^=menuitem],[role=option]',
      field: 'input:not([type=checkbox],[type=file]),select,textarea,[contenteditable=true]',
      button:
        'button,[role=button],[role=tab],[role=radio],[role=slider],[role=separator],input[type=checkbox],summary,[role=menubar] [role=menuitem]',
      row: '[role=row],[role=treeitem],[role=gridcell],[role=columnheader],li',
      canvas: 'canvas,[role=application],svg[role=img]',
    } as const;
    const found: { kind: keyof typeof kinds; x: number; y: number; width: number; height: number }[] = [];
    const tops = [...document.querySelectorAll('dialog[open],[role=menu]')];
    const roots: (Element | Document)[] = tops.length > 0 ? tops : [document];
    for (const root of roots) {
      for (const [kind, selector] of Object.entries(kinds)) {
        for (const node of root.querySelectorAll(selector)) {
          const { x, y, width, height } = node.getBoundingClientRect();
          if (width < 2 || height < 2 || x < 0 || y < 0 || x >= innerWidth || y >= innerHeight) continue;
          if (kind === 'item' && ends.test(node.textContent ?? '')) continue;
          // Keys of the table above.
          found.push({ kind: kind as keyof typeof kinds, x, y, width, height });
        }
      }
    }
    return found;
  }, NOT);
}
