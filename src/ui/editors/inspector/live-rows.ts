/**
 * Rows that follow playback. Only visible ones are updated, so that five hundred sliders cost as much as twenty.
 */
export class LiveRows {
  private readonly updates = new Map<Element, () => void>();
  private readonly visible = new Set<Element>();
  private readonly observer: IntersectionObserver;

  constructor(scroller: Element) {
    this.observer = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries) {
          if (!isIntersecting) this.visible.delete(target);
          else if (this.updates.has(target)) {
            this.visible.add(target);
            this.updates.get(target)?.();
          }
        }
      },
      { root: scroller, rootMargin: '64px 0px' },
    );
  }

  /** Updates at once, and from then on while visible. */
  add(row: Element, update: () => void): void {
    this.updates.set(row, update);
    this.observer.observe(row);
    update();
  }

  remove(row: Element): void {
    this.updates.delete(row);
    this.visible.delete(row);
    this.observer.unobserve(row);
  }

  update(): void {
    for (const row of this.visible) this.updates.get(row)?.();
  }
}
