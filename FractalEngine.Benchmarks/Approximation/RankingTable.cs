using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Approximation.Damaged;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>
/// Trains the network that ranks the maps of damaged trees, and compares it with other ways to rank: by votes, by a score, by what was true
/// of the most similar maps, and by nothing.
/// </summary>
internal static class RankingTable
{
    private const int FirstTrainingSeed = 10_000;
    private const int TrainingSeeds = 150;
    private const int FirstTestSeed = 20_000;
    private const int Units = 12;
    private const int Epochs = 300;
    private const double StepSize = 0.01;
    private const int NeighbourCount = 15;

    // Weights are drawn towards 0, so that few cases are enough.
    private const double Decay = 1e-4;

    private static readonly FractalKind[] Kinds = [FractalKind.TreeWithIdentity, FractalKind.SkewedTree];

    /// <summary>Trains the network from its seeds, and writes its weights.</summary>
    /// <param name="path">The file to write.</param>
    public static void Train(string path)
    {
        var cases = CasesOf(FirstTrainingSeed, TrainingSeeds).SelectMany(pair => pair.Cases).ToList();
        Console.WriteLine(FormattableString.Invariant($"{cases.Count} cases, {cases.Sum(one => one.Features.Length)} maps"));
        File.WriteAllText(path, Fit(cases).Write());
    }

    /// <summary>Writes how often all maps of a tree are among the first, by damage and method.</summary>
    public static void Write(TableOptions options)
    {
        var seeds = options.IsQuick ? 12 : 60;
        var known = CasesOf(FirstTrainingSeed, seeds).SelectMany(pair => pair.Cases)
            .SelectMany(one => one.Features.Zip(one.IsGenerator)).ToArray();
        var random = new SeededRandom("ranking", 0);
        (string Name, Func<double[], double> ScoreOf)[] methods =
        [
            ("votes", features => features[0]),
            ("score", features => features[0] * features[3]),
            ("neighbours", features => known.OrderBy(one => DistanceOf(one.First, features)).Take(NeighbourCount).Count(one => one.Second)),
            ("network", GeneratorRanking.ScoreOf),
            ("none", _ => random.Fraction()),
        ];
        var table = options.CreateTable("approximation-ranking.csv", "damage", "method", "cases", "all_among_first", "all_among_first_16");
        foreach (var (damage, cases) in CasesOf(FirstTestSeed, seeds))
        {
            foreach (var (name, scoreOf) in methods)
            {
                table.Add(
                    damage.Name, name, cases.Count, Percent(cases, scoreOf, one => one.GeneratorCount), Percent(cases, scoreOf, _ => 16));
            }
        }

        table.Save();
    }

    private static double Percent(List<RankingCase> cases, Func<double[], double> scoreOf, Func<RankingCase, int> firstOf) =>
        Math.Round(100.0 * cases.Count(one => one.Features.Zip(one.IsGenerator).OrderByDescending(map => scoreOf(map.First))
            .Take(firstOf(one)).Count(map => map.Second) >= one.GeneratorCount) / Math.Max(1, cases.Count), 1);

    private static double DistanceOf(double[] features1, double[] features2) =>
        features1.Zip(features2, (one, other) => (one - other) * (one - other)).Sum();

    private static IEnumerable<(Damage Damage, List<RankingCase> Cases)> CasesOf(int firstSeed, int seeds)
    {
        foreach (var damage in Damage.All.Where(damage => damage
            is { Kind: DamageKind.None or DamageKind.Missing or DamageKind.MissingAndStrangers }
            or { Kind: DamageKind.Noise, Amount: 0.01 }))
        {
            yield return (damage, [.. Kinds.SelectMany(kind => Enumerable.Range(firstSeed, seeds)
                .Select(seed => RankingCase.Create(kind, seed, 1_000 + (seed % 4 * 500), damage)).OfType<RankingCase>())]);
        }
    }

    /// <summary>Fits the weights by stochastic gradients of the logistic loss, with steps by Adam (Kingma and Ba 2015).</summary>
    private static Perceptron Fit(List<RankingCase> cases)
    {
        var random = new SeededRandom("weights", 1);
        var samples = cases.SelectMany(one => one.Features.Zip(one.IsGenerator)).ToArray();
        var inputs = samples[0].First.Length;
        var network = new Perceptron(
            [.. Enumerable.Range(0, Units).Select(_ => Enumerable.Range(0, inputs + 1).Select(_ => random.Between(-1, 1)).ToArray())],
            [.. Enumerable.Range(0, Units + 1).Select(_ => random.Between(-0.5, 0.5))]);
        var rows = network.Hidden.Append(network.Output).ToArray();
        var means = Array.ConvertAll(rows, row => new double[row.Length]);
        var squares = Array.ConvertAll(rows, row => new double[row.Length]);
        var units = new double[Units];
        // Of what there is less, each counts more.
        var weight = (double)samples.Count(sample => !sample.Second) / Math.Max(1, samples.Count(sample => sample.Second));
        const int Batch = 64;
        for (var (epoch, step) = (0, 0); epoch < Epochs; epoch++)
        {
            random.Shuffle(samples.AsSpan());
            foreach (var batch in samples.Chunk(Batch))
            {
                var gradients = Array.ConvertAll(rows, row => new double[row.Length]);
                foreach (var (features, isGenerator) in batch)
                {
                    var output = network.Evaluate(features, units);
                    var error = ((1 / (1 + Math.Exp(-output))) - (isGenerator ? 1 : 0)) * (isGenerator ? weight : 1) / batch.Length;
                    gradients[Units][Units] += error;
                    for (var unit = 0; unit < Units; unit++)
                    {
                        gradients[Units][unit] += error * units[unit];
                        // The slope of x/(1 + |x|) is (1 − |u|)² where it is u.
                        var inner = error * network.Output[unit] * (1 - Math.Abs(units[unit])) * (1 - Math.Abs(units[unit]));
                        for (var input = 0; input < inputs; input++)
                        {
                            gradients[unit][input] += inner * features[input];
                        }

                        gradients[unit][inputs] += inner;
                    }
                }

                step++;
                for (var row = 0; row < rows.Length; row++)
                {
                    for (var index = 0; index < rows[row].Length; index++)
                    {
                        var gradient = gradients[row][index] + (Decay * rows[row][index]);
                        means[row][index] = (0.9 * means[row][index]) + (0.1 * gradient);
                        squares[row][index] = (0.999 * squares[row][index]) + (0.001 * gradient * gradient);
                        rows[row][index] -= StepSize * (means[row][index] / (1 - Math.Pow(0.9, step)))
                            / (Math.Sqrt(squares[row][index] / (1 - Math.Pow(0.999, step))) + 1e-8);
                    }
                }
            }
        }

        return network;
    }
}
