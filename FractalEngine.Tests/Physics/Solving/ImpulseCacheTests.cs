using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Tests.Physics.Islands;

namespace FractalEngine.Tests.Physics.Solving;

/// <summary>The impulses of the step before, which contacts begin with.</summary>
public sealed class ImpulseCacheTests
{
    [Fact]
    public void Recall_OfTheSameContact_HasItsImpulses()
    {
        var (islands, cache) = Create();
        for (var i = 0; i < islands.RowCount; i++)
        {
            islands.Row(i).NormalImpulse = i + 1;
            islands.Row(i).FrictionImpulse = new(i, 2, 3);
            islands.Row(i).RollingArm = 1;
            islands.Row(i).TurnImpulse = new(4, i, 5);
        }

        cache.Store(islands, 1);
        for (var i = 0; i < islands.RowCount; i++)
        {
            var row = islands.Row(i) with { NormalImpulse = 99, FrictionImpulse = Vector.One };
            cache.Recall(ref row);
            Assert.Equal((i + 1.0, new(i, 2, 3), new(4, i, 5)), (row.NormalImpulse, row.FrictionImpulse, row.TurnImpulse));
            var another = row with { First = row.First + 200 };
            AssertForgotten(cache, another);
            AssertForgotten(cache, row with { Second = row.Second + 200 });
            AssertForgotten(cache, row with { FeatureId = 1 });
        }
    }

    /// <summary>A contact whose normal has turned by eight degrees is the same one, and by nine another.</summary>
    [Theory]
    [InlineData(8, true)]
    [InlineData(9, false)]
    public void Recall_OfANormalThatHasTurned_IsForAFewDegrees(double degrees, bool isSame)
    {
        var (islands, cache) = Create();
        islands.Row(0).NormalImpulse = 7;
        islands.Row(0).Normal = Vector.J;
        cache.Store(islands, 1);
        var angle = degrees * Math.PI / 180;
        ContactRow[] rows = [islands.Row(0) with { Normal = new(Math.Sin(angle), Math.Cos(angle), 0) }, islands.Row(0)];
        foreach (ref var row in rows.AsSpan())
        {
            cache.Recall(ref row);
        }

        Assert.Equal((isSame ? 7 : 0, 7.0), (rows[0].NormalImpulse, rows[1].NormalImpulse));
    }

    [Fact]
    public void Recall_OfWhatDidNotPush_HasNone()
    {
        var (islands, cache) = Create();
        islands.Row(0).FrictionImpulse = Vector.I;
        islands.Row(1).NormalImpulse = 1;
        cache.Store(islands, 1);
        AssertForgotten(cache, islands.Row(0));
        cache.Clear();
        AssertForgotten(cache, islands.Row(1));
        cache.Store(islands, 1);
        islands.Row(1).NormalImpulse = 0;
        cache.Store(islands, 1);
        AssertForgotten(cache, islands.Row(1) with { NormalImpulse = 3 });
    }

    /// <summary>Two contacts of one key and nearly one normal: the first one counts.</summary>
    [Fact]
    public void Recall_OfTwoThatAreTheSame_HasThoseOfTheFirst()
    {
        var (islands, cache) = Create();
        islands.Row(0).NormalImpulse = 1;
        islands.Row(2) = islands.Row(0) with { NormalImpulse = 3 };
        cache.Store(islands, 1);
        var row = islands.Row(2);
        cache.Recall(ref row);
        Assert.Equal(1, row.NormalImpulse);
    }

    private static void AssertForgotten(ImpulseCache cache, ContactRow row)
    {
        cache.Recall(ref row);
        Assert.Equal((0.0, Vector.Zero, Vector.Zero), (row.NormalImpulse, row.FrictionImpulse, row.TurnImpulse));
    }

    private static (IslandSet Islands, ImpulseCache Cache) Create()
    {
        // A row of forty balls that touch.
        var setup = new GraphOfBodies([.. Enumerable.Range(0, 40).Select(static i => new BodyDescription(new(i, 0, 0), 0.5))]);
        Assert.True(setup.TryGroup(0.25));
        Assert.Equal(39, setup.Islands.RowCount);
        var cache = new ImpulseCache();
        cache.Reserve(1);
        return (setup.Islands, cache);
    }
}
