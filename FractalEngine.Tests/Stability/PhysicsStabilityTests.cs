using System.Runtime.CompilerServices;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

/// <summary>Measures how far energies and positions drift. Tests/Physics check that bodies move and rest as they should.</summary>
public class PhysicsStabilityTests(ITestOutputHelper output)
{
    public static TheoryData<double> Steps => [1e-5, 1e-4, 1e-3, 1 / 240.0, 1 / 60.0, 0.1];

    /// <summary>Bounces without loss on a floor, so that the energy is the same in each step.</summary>
    [Theory]
    [MemberData(nameof(Steps))]
    public void Energy_OfASphereThatBouncesWithoutLoss_StaysAtAnyStep(double step) => CheckEnergy(step, 20_000);

    [Theory]
    [MemberData(nameof(Steps))]
    [Trait("Category", "Soak")]
    public void Energy_OfASphereThatBouncesWithoutLossForAMillionSteps_StaysAtAnyStep(double step) => CheckEnergy(step, 1_000_000);

    /// <summary>Compares the first top after the fall with e²·h. FlightTests hold every top to 1e-6.</summary>
    [Theory]
    [MemberData(nameof(Steps))]
    public void Bounce_OnAFloor_RisesToRestitutionSquaredAtAnyStep(double step)
    {
        using var report = new StabilityReport(output, step);
        Seeded.Run(step < 1e-3 ? 4 : 50, random =>
        {
            var e = random.Between(0.5, 1);
            var height = random.Between(0.5, 2);
            var world = TestWorlds.Create(TestWorlds.Gravity, step, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
            var body = world.Add(new(new(0, 0.1 + height, 0), 0.1) { Restitution = e });
            while (body.Velocity.Y <= 0)
            {
                world.Step();
            }

            var top = body.Position.Y - 0.1 + (body.Velocity.Y * body.Velocity.Y / (2 * 9.8));
            // The promise is 1 %, but the moment of an impact is found to 1e-10 of the radius.
            var error = Math.Abs(top - (e * e * height)) / height;
            report.Require("height of a bounce off e²·h (of h)", error, 1e-8, () => $"e {e}, h {height}: {top}");
        });
    }

    /// <summary>Measures the drift of a body at rest. RestTests hold a million steps at eight positions to 1e-9 units.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Rest_OnASponge_DoesNotMove(bool sleeps)
    {
        using var report = new StabilityReport(output, sleeps ? "asleep" : "awake");
        var settings = new PhysicsSettings { SleepSpeed = sleeps ? null : 0 };
        var world = TestWorlds.Create(TestWorlds.Gravity, settings, TestWorlds.Place(AssetFractals.Load("menger", 2)));
        var body = world.Add(new(new(0.02, 0.9, 0.01), 0.2) { Friction = 0.5 });
        world.Run(600);
        var restPosition = body.Position;
        world.Run(20_000, () => report.Require(
            "way from the place of rest on a sponge (units)", (body.Position - restPosition).Length(), 1e-9,
            () => $"after {world.StepCount} steps"));
    }

    /// <summary>Runs many worlds at once, each on some thread. None may affect another. DeterminismTests compare six.</summary>
    [Fact]
    public void StateHash_OfWorldsInParallel_IsThatOfEachAlone()
    {
        using var report = new StabilityReport(output);
        var alone = Enumerable.Range(0, 12).Select(Hash).ToArray();
        var together = new string[48];
        Parallel.For(0, together.Length, i => together[i] = Hash(i % alone.Length));
        Assert.Equal(alone.Length, alone.Distinct().Count());
        for (var i = 0; i < together.Length; i++)
        {
            var difference = together[i] == alone[i % alone.Length] ? 0 : 1;
            report.Require("worlds that differ when they run in parallel", difference, 0, () => $"world {i}");
        }
    }

    private void CheckEnergy(double step, int steps, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, step, test);
        var world = TestWorlds.Create(TestWorlds.Gravity, step, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        // What gravity adds in a step is small beside the speed of the impacts, so that none counts as rest.
        world.Add(new(new(0.3, 3.1, -0.2), 0.1) { Restitution = 1 });
        var energy = world.Energy();
        // An impact is found to 1e-10 of the radius, which is 1e-11 of the height or less. The sums of a step round by 2⁻⁵².
        world.Run(steps, () => report.Require(
            "energy of a ball that bounces with e = 1 by steps (of the first)",
            Math.Abs(world.Energy() - energy) / energy,
            (1e-11 * (1 + (world.Time / 1.5))) + (1e-15 * world.StepCount),
            () => $"after {world.StepCount} steps",
            RoundNumbers.From(world.StepCount)));
    }

    private static string Hash(int seed)
    {
        var random = new Random(seed);
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(AssetFractals.Load("menger", 2)));
        world.AddRange(Enumerable.Range(0, 6).Select(i => new BodyDescription(new((i % 3 * 0.3) - 0.3, 0.8, (i / 3 * 0.3) - 0.2), 0.1)
        {
            Velocity = random.Vector(),
            Restitution = random.NextDouble(),
        }));
        world.Run(120);
        return world.StateHash;
    }
}
