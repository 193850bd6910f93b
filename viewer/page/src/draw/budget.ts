// How many roads this machine draws in a given time, learnt from the frames drawn: a graphics card draws all of them, a
// program that draws in software a coarser picture while things move.

export class Budget {
  private roads_per_ms: number;
  constructor(software: boolean) { this.roads_per_ms = software ? 500 : 10000; }

  /** `fixed_ms` of a frame do not depend on the roads. */
  learn(roads: number, frame_ms: number, fixed_ms = 12): void {
    if (roads < 5000) return;
    const seen = roads / Math.max(1, frame_ms - fixed_ms);
    this.roads_per_ms += (Math.min(20000, seen) - this.roads_per_ms) * 0.2;
  }

  roads_in(ms: number): number { return this.roads_per_ms * ms; }
}
