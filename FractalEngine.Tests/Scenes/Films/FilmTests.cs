using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Render.Cameras;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes.Films;

/// <summary>Tests numbers and cameras of films between their keys, by closed forms.</summary>
public class FilmTests
{
    [Theory]
    [InlineData(Ease.Linear, 0.25)]
    [InlineData(Ease.In, 0.0625)]
    [InlineData(Ease.Out, 0.4375)]
    [InlineData(Ease.InOut, 0.15625)]
    [InlineData(Ease.Hold, 0)]
    public void ValuesAt_QuarterOfTheWay_IsTheClosedFormOfItsEase(Ease ease, double progress)
    {
        var film = new Film(20)
        {
            // The keys of another number stand between.
            Keys = [new NumberKey(2, "a", -3), new NumberKey(0, "b", 7), new NumberKey(10, "a", 13) { Ease = ease }],
        };
        Assert.Equal(-3 + (16 * progress), film.ValuesAt(4)["a"]);
        Assert.Equal(7, film.ValuesAt(4)["b"]);
        Assert.Equal((-3, -3, 13, 13), (film.ValuesAt(0)["a"], film.ValuesAt(2)["a"], film.ValuesAt(10)["a"], film.ValuesAt(20)["a"]));
    }

    [Fact]
    public void ValuesAt_TimeOfAKey_IsItsValueToTheBit()
    {
        double[] values = [0.1, 1e300, -1e-300, -0.0, 1.0 / 3, 5e-324];
        var keys = values.Select((value, index) => new NumberKey(index / 7.0, "a", value) { Ease = (Ease)(index % 5) }).ToArray();
        var film = new Film(1) { Keys = [.. keys] };
        Assert.All(keys, key => Assert.Equal(
            BitConverter.DoubleToInt64Bits(key.Value + 0.0), BitConverter.DoubleToInt64Bits(film.ValuesAt(key.Time)["a"] + 0.0)));
    }

    /// <summary>The law of flights between scales: at an even pace each second takes the same factor of the distance.</summary>
    [Fact]
    public void Path_TwoKeysThatLookAtOnePoint_FliesByTheSameFactorEachSecond()
    {
        Vector target = new(1, -2, 3), direction = new Vector(2, 1, -2) / 3;
        var path = new CameraPath([Look(1, target + (1e6 * direction), target), Look(7, target + direction, target)], Handedness.Left);
        for (double time = 1; time <= 7; time += 0.375)
        {
            var camera = path.At(time);
            double distance = Math.Pow(10, 7 - time);
            // The position has a rounding of its coordinates, and the distance one of its logarithm.
            Near.Equal(target + (distance * direction), camera.Position, (1e-14 * distance) + 1e-14);
            Near.Equal(-direction, camera.LocalAxes.V3, 1e-12);
        }
    }

    [Theory]
    [InlineData(Handedness.Left)]
    [InlineData(Handedness.Right)]
    public void Path_TimesOfKeys_HasTheCamerasOfTheKeys(Handedness handedness)
    {
        CameraKey[] keys =
        [
            Look(0.5, new(0, 2, 9), Vector.Zero), Look(1, new(3, 1, 0.1), Vector.Zero) with { Ease = Ease.InOut },
            new(4, new(new(9, 9, 1), new(0.3, 2, 0.1), 30)), Look(4.125, new(1e-3, 0, 0), new(0, 0, 5)),
            Look(9, new(-4, 0, 0), new(0, 1, 5)) with { Ease = Ease.Hold },
        ];
        var path = new CameraPath(keys, handedness);
        Assert.All(keys, key =>
        {
            var camera = path.At(key.Time);
            Assert.Equal(
                (key.Camera.Position, key.Camera.FieldOfView, handedness), (camera.Position, camera.FieldOfView, camera.Handedness));
            if (key.Target is var (point, _))
            {
                Near.Equal((point - camera.Position).UnitVector(), camera.LocalAxes.V3, 1e-12);
            }
        });
        Assert.Equal((path.At(0.5), path.At(9)), (path.At(-1), path.At(100)));
        Assert.Equal(path.At(4.125), path.At(8.999));
    }

    /// <summary>Positions of equal laws on both sides of a key, and at the border of two laws: the velocity has no jump.</summary>
    [Fact]
    public void Path_AtItsKeys_HasNoJumpOfVelocity()
    {
        Vector target = new(0, 1, 0);
        var path = new CameraPath(
            [
                Look(0, new(0, 2, 9), target), Look(1, new(5, 2, 3), target), Look(4, new(2, 1, -0.5), target),
                Look(5, new(2, 3, -4), new(1, 1, 1)), new(7, new(new(0, 0, -9), new(0, 3, 0), 60)), Look(8, new(1, 0, -9), Vector.Zero),
            ],
            Handedness.Left);
        const double step = 1e-5;
        foreach (double time in (double[])[1, 4, 5, 7])
        {
            var before = (path.At(time).Position - path.At(time - step).Position) / step;
            var after = (path.At(time + step).Position - path.At(time).Position) / step;
            // Accelerations of up to 100 units a square second.
            Near.Equal(before, after, 100 * step);
            Assert.True(before.Length() > 0.1, "it passes the key without a stop");
        }
    }

    [Fact]
    public void Path_BetweenLooks_AimsAndNeverRolls()
    {
        Vector target = new(0, 1, 0);
        var path = new CameraPath(
            [Look(0, new(0, 2, 9), target), Look(1, new(9, 2, 0), target), Look(3, new(0, 6, -9), target), Look(4, new(1, 1, 1), Vector.I)],
            Handedness.Right);
        for (double time = 0; time <= 4; time += 0.11)
        {
            var axes = path.At(time).LocalAxes;
            Near.Equal(0, axes.V1.Y, 1e-12);
            Assert.True(axes.V2.Y > 0, $"upright at {time}");
            Assert.True(time > 3 || Vector.Dot((target - path.At(time).Position).UnitVector(), axes.V3) > 1 - 1e-12, $"aims at {time}");
        }
    }

    /// <summary>Frames load a scene anew where any of its numbers has changed, and only there.</summary>
    [Fact]
    public void HasSameValuesAt_WhileOneOfTwoNumbersChanges_IsFalse()
    {
        var film = new Film(9)
        {
            Keys = [new NumberKey(0, "a", 1), new NumberKey(2, "a", 1), new NumberKey(0, "b", 1), new NumberKey(2, "b", 3)],
        };
        Assert.False(film.HasSameValuesAt(0, 1));
        Assert.True(film.HasSameValuesAt(2, 8));
    }

    [Fact]
    public void Path_OfALens_ChangesItFromKeyToKey()
    {
        var (near, far) = (Look(0, new(0, 0, 9), Vector.Zero), Look(2, new(0, 0, 3), Vector.Zero));
        CameraKey[] keys =
        [
            near with { Camera = near.Camera with { Aperture = 1, FocusDepth = 9 } },
            far with { Camera = far.Camera with { Aperture = 0.5, FocusDepth = 3 } },
        ];
        var path = new CameraPath(keys, Handedness.Left);
        Assert.Equal([(1, 9), (0.875, 7.5), (0.5, 3)], new[] { 0, 0.5, 2 }.Select(path.At).Select(
            static camera => (camera.Aperture, camera.FocusDepth)));
    }

    /// <summary>What is held jumps: the camera comes to rest at the key before as if that were the last one.</summary>
    [Fact]
    public void Path_BeforeAKeyThatIsHeld_KnowsNothingOfIt()
    {
        CameraKey[] keys = [new(0, new(new(0, 0, 9), Vector.Zero, 50)), new(1, new(new(3, 0, 9), Vector.Zero, 50))];
        var held = new CameraKey(2, new(new(99, 99, 9), Vector.Zero, 50)) { Ease = Ease.Hold };
        var (path, withoutIt) = (new CameraPath([.. keys, held], Handedness.Left), new CameraPath(keys, Handedness.Left));
        Assert.Equal(withoutIt.At(0.75), path.At(0.75));
    }

    [Fact]
    public void Path_OneKey_StandsStill()
    {
        var path = new CameraPath([Look(3, new(0, 2, 9), Vector.Zero)], Handedness.Left);
        Assert.Equal(path.At(0), path.At(10));
    }

    [Fact]
    public void Path_WithoutKeys_IsRefused() =>
        Assert.Throws<ArgumentOutOfRangeException>(() => new CameraPath(Array.Empty<CameraKey>(), Handedness.Left));

    private static CameraKey Look(double time, Vector position, Vector target) =>
        new(time, new(position, Vector.Zero, 50)) { Target = (target, Vector.J) };
}
