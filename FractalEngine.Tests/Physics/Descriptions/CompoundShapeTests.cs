using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Descriptions;

/// <summary>Mass properties of compounds against closed forms, and their fit to models.</summary>
public class CompoundShapeTests
{
    [Fact]
    public void OfBalls_OfADumbbell_HasTheInertiaOfTwoBalls()
    {
        var shape = CompoundShape.OfBalls([new(new(-2, 0, 0), 0.5), new(new(2, 0, 0), 0.5)]);
        // 2/5·r², and d² of parallel axes.
        Near.Equal(Matrix.Diagonal(new(0.1, 4.1, 4.1)), shape.Inertia, 1e-15);
        Assert.Equal((Vector.Zero, 2.5), (shape.Centre, shape.Radius));
    }

    [Fact]
    public void OfBalls_OfTwoSizes_HasItsCentreByVolume()
    {
        var shape = CompoundShape.OfBalls([new(Vector.Zero, 1), new(new(0, 9, 0), 2)]);
        Near.Equal(new(0, 8, 0), shape.Centre, 1e-15);
        Near.Equal(new(0, -8, 0), shape.Balls[0].Offset, 1e-15);
    }

    [Fact]
    public void Inertia_OfACapsule_IsThatOfItsVolume() => Seeded.Run(3, random =>
    {
        var shape = CompoundShape.Capsule(random.Vector(), random.Vector(), 0.3);
        var axis = shape.Balls[^1].Offset - shape.Balls[0].Offset;
        var sum = 0 * Matrix.Identity;
        var count = 0;
        for (var i = 0; i < 400_000; i++)
        {
            var point = random.Vector(shape.Radius);
            var share = Math.Clamp((Vector.Dot(point, axis) / axis.LengthSquared()) + 0.5, 0, 1);
            if ((point - ((share - 0.5) * axis)).Length() <= 0.3)
            {
                sum += (point.LengthSquared() * Matrix.Identity) + (-1 * Matrix.Outer(point, point));
                count++;
            }
        }

        // Monte Carlo: some 10⁵ points tell three digits.
        Near.Equal(shape.Inertia, sum / count, 0.01 * shape.Inertia.MaxAbsEntry());
    });

    [Fact]
    public void Capsule_WithoutLength_IsABall()
    {
        var shape = CompoundShape.Capsule(Vector.One, Vector.One, 2);
        Assert.Single(shape.Balls);
        Near.Equal(1.6 * Matrix.Identity, shape.Inertia, 1e-15);
    }

    /// <summary>A cylinder of 3/4 of the matter between two half balls, with m·r²/2 and m·(l²/12 + r²/4), and parallel axes.</summary>
    [Fact]
    public void Inertia_OfACapsule_IsItsClosedForm()
    {
        var shape = CompoundShape.Capsule(-1 * Vector.J, Vector.J, 0.5);
        var along = (0.75 * 0.125) + (0.25 * 0.1);
        // A half ball has 0.4·r² − (3/8·r)² about its own centre, which is 1 + 3/8·r away.
        var across = (0.75 * ((4 / 12.0) + 0.0625)) + (0.25 * (0.1 - (0.1875 * 0.1875) + (1.1875 * 1.1875)));
        Near.Equal(Matrix.Diagonal(new(across, along, across)), shape.Inertia, 1e-15);
        Assert.Equal((1.5, 9, true), (shape.Radius, shape.Balls.Length, shape.IsCapsule));
        Assert.All(shape.Balls.Index(), static ball => Near.Equal(((0.25 * ball.Index) - 1) * Vector.J, ball.Item.Offset, 1e-15));
    }

    [Fact]
    public void Shapes_AtTheirLimits_AreMadeAndBeyondNamed()
    {
        Assert.Equal(64, CompoundShape.Capsule(Vector.Zero, 63 * Vector.I, 2).Balls.Length);
        Assert.Equal(64, CompoundShape.OfBalls(Enumerable.Repeat(new CompoundBall(Vector.I, 2), 64)).Balls.Length);
        (Action Call, string Message)[] wrong =
        [
            (() => CompoundShape.OfBalls([]), "expected 1 to 64 balls"),
            (() => CompoundShape.OfBalls(Enumerable.Repeat(new CompoundBall(Vector.I, 2), 65)), "expected 1 to 64 balls"),
            (() => CompoundShape.OfBalls([new(new(0, double.NaN, 0), 1)]), "the offsets of balls must be finite"),
            (() => CompoundShape.OfBalls([new(Vector.I, 1), new(Vector.I, 0)]), "the radii of balls must be positive"),
            (() => CompoundShape.OfBalls([new(Vector.I, double.PositiveInfinity)]), "the radii of balls must be positive"),
            (() => CompoundShape.Capsule(new(0, double.NaN, 0), Vector.I, 1), "the ends of a capsule must be finite"),
            (() => CompoundShape.Capsule(Vector.I, new(double.NaN, 0, 0), 1), "the ends of a capsule must be finite"),
            (() => CompoundShape.Capsule(Vector.I, Vector.J, 0), "the radius of a capsule must be positive"),
            (() => CompoundShape.Capsule(Vector.I, Vector.J, double.PositiveInfinity), "the radius of a capsule must be positive"),
            (() => CompoundShape.Capsule(Vector.Zero, 63.01 * Vector.I, 2), "a capsule may be 31.5 radii longer than its ends"),
        ];
        Assert.All(wrong, static call => Assert.Equal(call.Message, Assert.Throws<ArgumentException>(call.Call).Message));
    }

    [Fact]
    public void Shapes_OfWrongNumbers_AreRefused()
    {
        Assert.Throws<ArgumentException>(() => CompoundShape.OfBalls([]));
        Assert.Throws<ArgumentException>(() => CompoundShape.OfBalls([new(Vector.Zero, 0)]));
        Assert.Throws<ArgumentException>(() => CompoundShape.OfBalls([new(new(double.NaN, 0, 0), 1)]));
        Assert.Throws<ArgumentException>(() => CompoundShape.Capsule(Vector.Zero, 100 * Vector.I, 1));
        var ball = CompoundShape.OfBalls([new(Vector.Zero, 2)]);
        Assert.Throws<ArgumentException>(() => new PhysicsWorld().Add(new(Vector.Zero, 1) { Shape = ball }));
    }

    [Fact]
    public void Capsule_OfAPlank_HoldsAllItsVertices()
    {
        var placed = new PlacedModel(new PhysicsObject(Model.Of(PhysicsMeshes.Cube))
        {
            Placement = new(new(1, 2, 3), new(0, 30, 0), new(4, 0.5, 0.4)), Shape = BodyShape.Capsule,
        });
        var body = Assert.Single(new PhysicsWorld(new LoadedScene(new(), [placed])).Bodies);
        Assert.True(body.BallCount > 5);
        for (var vertex = 0; vertex < placed.Model.Mesh.VertexCount; vertex++)
        {
            var point = placed.ObjectToWorld * placed.Model.Mesh.Vertex(vertex);
            // Balls half a radius apart lie 1/32 of it below the capsule.
            Assert.Contains(
                Enumerable.Range(0, body.BallCount), ball => (body.BallCentre(ball) - point).Length() <= body.BallRadius(ball) * 1.04);
        }

        // It is drawn where it was placed.
        Near.Equal(placed.ObjectToWorld.Translation, body.InterpolatedMap(1).Translation, 1e-12);
    }

    /// <summary>A model may lie anywhere about its origin; the body turns about its centre.</summary>
    [Fact]
    public void GetCurrentScene_OfACompoundBesideItsOrigin_HasItWhereItsBallsAre()
    {
        var plank = new Mesh([6, 0, 0, 9, 0, 0, 6, 0.4, 0, 6, 0, 0.4], [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
        var placed = new PlacedModel(new PhysicsObject(Model.Of(plank))
        {
            Placement = new(new(1, 2, 3), new(0, 30, 20), 1.5 * Vector.One), Shape = BodyShape.Capsule, Velocity = new(3, 1, -2),
        });
        var world = new PhysicsWorld(new LoadedScene(new(), [placed])) { Gravity = new(0, -10, 0) };
        world.AddStatic(Model.Of(PhysicsMeshes.Cube)).MoveTo(new(new(0, -100, 0), Vector.Zero, 100 * Vector.One));
        var body = Assert.Single(world.Bodies);
        // It falls onto the floor, and turns there.
        for (var step = 0; step < 300; step++)
        {
            world.Step(1.0 / 60);
        }

        Assert.NotEqual(Orientation.Identity, body.Orientation);
        foreach (var alpha in (double[])[1, 1 - 1e-9])
        {
            var moved = world.GetCurrentScene(alpha).Objects[0];
            for (var vertex = 0; vertex < plank.VertexCount; vertex++)
            {
                var point = moved.ObjectToWorld * plank.Vertex(vertex);
                Assert.Contains(Enumerable.Range(0, body.BallCount), ball =>
                    (body.BallCentre(ball) - point).Length() <= body.BallRadius(ball) * 1.04);
            }
        }
    }

    [Fact]
    public void Balls_OfACube_CoverItsVertices()
    {
        var placed = new PlacedModel(new PhysicsObject(Model.Of(PhysicsMeshes.Cube)) { Shape = BodyShape.Balls(8) });
        var body = Assert.Single(new PhysicsWorld(new LoadedScene(new(), [placed])).Bodies);
        Assert.Equal(8, body.BallCount);
        for (var vertex = 0; vertex < placed.Model.Mesh.VertexCount; vertex++)
        {
            var point = placed.Model.Mesh.Vertex(vertex);
            var distance = Enumerable.Range(0, body.BallCount)
                .Min(ball => (body.BallCentre(ball) - point).Length() - body.BallRadius(ball));
            Assert.InRange(distance, double.NegativeInfinity, 1e-12);
        }
    }

    [Fact]
    public void OneBall_OfACube_IsTheBallAroundIt()
    {
        var placed = new PlacedModel(new PhysicsObject(Model.Of(PhysicsMeshes.Cube)) { Shape = BodyShape.Balls(1) });
        var body = Assert.Single(new PhysicsWorld(new LoadedScene(new(), [placed])).Bodies);
        Near.Equal(placed.Model.Bounds.Centre, body.BallCentre(0), 1e-12);
        Assert.Equal(0.5 * placed.Model.Bounds.Size.Length(), body.BallRadius(0), 1e-12);
    }

    [Fact]
    public void Balls_OfAFanOfAHundredThousandFaces_CoverItInASecond()
    {
        const int Count = 100_000;
        static Vector Corner(int i) => new(Math.Cos(Math.Tau * i / Count), Math.Sin(Math.Tau * i / Count), 0);
        var corners = Enumerable.Range(0, Count).Select(Corner).ToArray();
        var fan = PhysicsMeshes.FromTriangles([.. corners.Select((corner, i) => (corner, Corner((i + 1) % Count), Vector.Zero))]);
        var placed = new PlacedModel(new PhysicsObject(Model.Of(fan)) { Shape = BodyShape.Balls(64) });
        var before = Environment.CpuUsage.TotalTime;
        var body = Assert.Single(new PhysicsWorld(new LoadedScene(new(), [placed])).Bodies);
        Assert.InRange((Environment.CpuUsage.TotalTime - before).TotalSeconds, 0, 3);
        foreach (var corner in corners)
        {
            Assert.Contains(
                Enumerable.Range(0, body.BallCount),
                ball => (body.BallCentre(ball) - corner).Length() <= body.BallRadius(ball) * (1 + 1e-12));
        }
    }
}
