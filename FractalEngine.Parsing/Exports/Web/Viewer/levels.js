// The levels of a fractal: integers in a shape, and the numbers of its maps, boxes and tints.
class Levels {
  constructor(data) {
    this.data = data;
    this.shape = data.shape;
    this.values = Float64Array.from(data.values);
    this.boxes = 12 * this.shape.maps;
    this.tints = this.boxes + 6 * this.shape.levels.length;
    const hasPicks = this.shape.levels.some(level => level[3]);
    this.stride = hasPicks ? 8 : 5;
    this.lists = this.shape.lists.map(list => hasPicks
      ? list.map((number, i) => i % 8 === 5 || i % 8 === 6 ? BigInt(number) : number) : list);
    this.items = this.shape.levels.map(([mesh, isEmpty, list, choice], index) => ({
      index, mesh, isEmpty, list: this.lists[list], choice: choice && this.choiceOf(choice), box: this.boxes + 6 * index,
    }));
    this.start = this.resolve({ level: this.shape.start[0], way: BigInt(this.shape.start[1]), size: this.shape.start[2] });
    this.means = new Map();
    this.rests = new Map();
  }

  choiceOf(choice) {
    return choice.length === 1 ? { maxSize: choice[0] }
      : { ends: choice[0].map(BigInt), seed: BigInt(choice[1]), byLevel: choice[2] };
  }

  // What stands at a level, which recurs in its run.
  itemAt(level) {
    const runs = this.shape.runs;
    for (let i = runs.length - 1; ; i--) {
      const [first, count, index, period] = runs[i];
      if (level >= first) return this.items[index + (level - first) % period];
    }
  }

  // The place that a child is at.
  enter(place, list, at) {
    const step = list[at + 3], level = step < 0 ? -1 - step : place.level - step;
    return this.stride === 5 ? { level, way: 0n, size: 0 } : this.resolve({
      level, way: BigInt.asUintN(64, place.way * list[at + 5] + list[at + 6]), size: place.size + list[at + 7],
    });
  }

  // Goes on as far as places decide. Choices have no maps and no colours of their own.
  resolve(place) {
    for (let item = this.itemAt(place.level); item.choice; item = this.itemAt(place.level)) {
      const { list, choice } = item;
      let index = 0;
      if (choice.ends) {
        const by = choice.byLevel;
        const number = by && Math.floor((by[0] - by[1]) / by[2]) - Math.floor((place.level - by[1]) / by[2]);
        if (by && by[3].length) {
          index = by[3].filter(first => first <= number).length - 1;
        } else {
          const hash = mixBits((by ? this.wayOf(number) : place.way) + choice.seed);
          while (index < choice.ends.length - 1 && hash >= choice.ends[index]) index++;
        }
      } else {
        index = place.size <= choice.maxSize ? 0 : 1;
      }
      const at = index * this.stride, step = list[at + 3];
      place = {
        level: step < 0 ? -1 - step : place.level - step, way: BigInt.asUintN(64, place.way * list[at + 5] + list[at + 6]),
        size: place.size + list[at + 7],
      };
    }
    return place;
  }

  wayOf(number) {
    return BigInt.asUintN(64, (BigInt(number) + 1n) * 6364136223846793005n + 1n);
  }

  // The mean tint of what is within a level, which its proxy has, weighted by areas. Deep levels have about the mean of those above.
  meanTint(level, depth = 0) {
    const item = this.itemAt(level);
    if (!this.shape.tints || !item.list.length || depth > 6) return [0, 0, 0, 1];
    let mean = this.means.get(item.index);
    if (!mean) {
      const sum = [0, 0, 0, 0];
      let weights = 0;
      for (let at = 0; at < item.list.length; at += this.stride) {
        const next = this.enter({ level, way: 0n, size: 0 }, item.list, at).level;
        const below = this.itemAt(next);
        if (below.isEmpty) continue;
        const weight = this.areaOf(item.list[at]), inner = this.meanTint(next, depth + 1), own = this.tintOf(item.list[at + 4]);
        for (let k = 0; k < 4; k++) sum[k] += weight * ((k < 3 ? own[k] : 0) + own[3] * inner[k]);
        weights += weight;
      }
      mean = sum.map(x => x / (weights || 1));
      if (depth === 0) this.means.set(item.index, mean);
    }
    return mean;
  }

  tintOf(number) {
    return number < 0 ? [0, 0, 0, 1] : this.values.subarray(this.tints + 4 * number, this.tints + 4 * number + 4);
  }

  // The mean number of maps other than the identity that lead from a level to what is within; 0 where there are very many.
  restOf(level) {
    if (level > 200) return 0;
    let rest = this.rests.get(level);
    if (rest === undefined) {
      const { list } = this.itemAt(level);
      let sum = 0, weights = 0;
      for (let at = 0; at < list.length; at += this.stride) {
        const next = list[at + 3] < 0 ? -1 - list[at + 3] : level - list[at + 3];
        if (this.itemAt(next).isEmpty) continue;
        const weight = this.areaOf(list[at]);
        sum += weight * ((list[at + 1] < 0 ? 0 : 1) + this.restOf(next));
        weights += weight;
      }
      rest = sum / (weights || 1);
      this.rests.set(level, rest);
    }
    return rest;
  }

  areaOf(map) {
    const v = this.values, m = 12 * map;
    return Math.cbrt((v[m] * (v[m + 5] * v[m + 10] - v[m + 6] * v[m + 9]) + v[m + 1] * (v[m + 6] * v[m + 8] - v[m + 4] * v[m + 10])
      + v[m + 2] * (v[m + 4] * v[m + 9] - v[m + 5] * v[m + 8])) ** 2);
  }
}

// The finalizer of SplitMix64.
function mixBits(bits) {
  bits = BigInt.asUintN(64, bits);
  bits = BigInt.asUintN(64, (bits ^ bits >> 30n) * 0xBF58476D1CE4E5B9n);
  bits = BigInt.asUintN(64, (bits ^ bits >> 27n) * 0x94D049BB133111EBn);
  return bits ^ bits >> 31n;
}
