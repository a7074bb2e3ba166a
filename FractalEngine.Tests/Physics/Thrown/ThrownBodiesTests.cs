using System.Diagnostics;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;
using Xunit.Sdk;

namespace FractalEngine.Tests.Physics.Thrown;

/// <summary>Bodies of all shapes, thrown at random: in each step they keep to what is guaranteed (docs/physics.md).</summary>
public class ThrownBodiesTests(ITestOutputHelper output)
{
    // In each sixth world all steps are made a second time, on two threads.
    private const int ThreadsPeriod = 6;

    [Fact]
    public void Bodies_Thrown_KeepToWhatIsGuaranteed() => Throw(1, 400);

    /// <summary>Bodies that are put where they may not be, or made faster, are noticed.</summary>
    [Fact]
    public void Laws_SeeBodiesBeyondWallsAndWithinOthersAndTooFast() => Seeded.RunMost(60, static random =>
    {
        var thrown = new ThrownWorld(random);
        var world = thrown.Create(1);
        var laws = new ThrownLaws(thrown, world);
        laws.BeginStep();
        Assert.Null(laws.FindFault());
        if (!thrown.HasPlate)
        {
            world.SetVelocity(world.Bodies.MaxBy(static body => body.Description.Mass)!, 1e8 * thrown.Size * Vector.I);
            Assert.StartsWith("energy", laws.FindFault(), StringComparison.Ordinal);
        }

        var place = thrown.IsFree ? thrown.Bodies[^1].Position : -1000 * thrown.Size * Vector.J;
        thrown.Bodies[0] = thrown.Bodies[0] with { Position = place };
        laws = new(thrown, thrown.Create(1));
        laws.BeginStep();
        // A small ball fits between the cubes of some fractals.
        return laws.FindFault() is not null;
    });

    /// <summary>So many as the variable FRACTALENGINE_BODIES says, from the seed that FRACTALENGINE_SEED says.</summary>
    [Fact]
    [Trait("Category", "Soak")]
    public void ManyBodies_Thrown_KeepToWhatIsGuaranteed() =>
        Throw(LongRuns.NumberOf("FRACTALENGINE_SEED", 1000), LongRuns.NumberOf("FRACTALENGINE_BODIES", 20_000));

    /// <summary>Goes on after a fault, so that a long run finds all of them.</summary>
    private void Throw(int firstSeed, int count)
    {
        List<string> faults = [];
        SortedDictionary<string, int> counts = [];
        var (seed, steps, total) = (firstSeed, 0L, 0);
        var clock = Stopwatch.StartNew();
        for (; total < count; seed++)
        {
            try
            {
                Seeded.RunOne(seed, random =>
                {
                    var thrown = new ThrownWorld(random);
                    total += thrown.Bodies.Count;
                    steps += thrown.Bodies.Count * thrown.StepCount;
                    foreach (var shape in thrown.Shapes)
                    {
                        counts[shape.Name] = counts.GetValueOrDefault(shape.Name) + 1;
                    }

                    Check(thrown, seed % ThreadsPeriod == 0);
                });
            }
            catch (XunitException fault)
            {
                faults.Add(fault.Message);
            }
        }

        var seconds = clock.Elapsed.TotalSeconds;
        var sums = FormattableString.Invariant($"{total} bodies, {steps} steps of one, {seconds:f0} s, {faults.Count} faults");
        output.WriteLine($"seeds {firstSeed} to {seed - 1}: {sums}");
        output.WriteLine(string.Join(", ", counts.Select(static pair => $"{pair.Value} {pair.Key}")));
        Assert.True(faults.Count == 0, string.Join('\n', faults));
    }

    private static void Check(ThrownWorld thrown, bool withThreads)
    {
        var world = thrown.Create(1);
        var other = withThreads ? thrown.Create(2) : null;
        var laws = new ThrownLaws(thrown, world);
        for (var step = 0; step < thrown.StepCount; step++)
        {
            laws.BeginStep();
            world.Step();
            other?.Step();
            var fault = laws.FindFault()
                ?? (other is not null && other.StateHash != world.StateHash ? "other bits on two threads" : null);
            if (fault is not null)
            {
                throw new XunitException($"{fault} after {step + 1} steps; {thrown.Name}");
            }
        }
    }
}
