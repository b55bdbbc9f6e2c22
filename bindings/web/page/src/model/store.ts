// One reactive state: whoever shows something subscribes, whoever changes something sets, and all is shown once a change.

export class Store<State extends object> {
  private listeners: ((state: State) => void)[] = [];
  private waiting = false;

  constructor(private current: State) {}

  get state(): Readonly<State> {
    return this.current;
  }

  /** Changes some fields. Listeners hear of all changes of one turn together. */
  set(change: Partial<State>): void {
    this.current = { ...this.current, ...change };
    if (this.waiting) return;
    this.waiting = true;
    queueMicrotask(() => {
      this.waiting = false;
      for (const listener of this.listeners) listener(this.current);
    });
  }

  /** Calls `listener` now and after every change. */
  subscribe(listener: (state: State) => void): void {
    this.listeners.push(listener);
    listener(this.current);
  }
}
