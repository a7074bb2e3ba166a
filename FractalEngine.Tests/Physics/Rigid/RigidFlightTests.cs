using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Bodies that touch nothing, against the mechanics of rigid bodies.</summary>
public class RigidFlightTests
{
    public static TheoryData<string> Shapes => ["box", "cone", "cylinder", "crooked", "plank"];

    [Theory]
    [MemberData(nameof(Shapes))]
    public void Flight_OfAMinute_KeepsEnergyAndAngularMomentumAndAParabola(string name)
    {
        var mesh = MeshOf(name);
        var inertia = SolidMoments.Of(mesh, AffineMap.Identity).Inertia;
        foreach (var spin in new Vector[] { new(10, 0.01, 0), new(0.01, 10, 0), new(3, -4, 5), new(0.1, 0.2, 10), new(0.02, 0, 0) })
        {
            var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
            var (start, velocity) = (new Vector(1, 2, 3), new Vector(3, 290, -1));
            var body = world.Add(RigidMeshes.Describe(mesh, start) with { Mass = 2, Velocity = velocity, AngularVelocity = spin });
            var momentum = inertia * spin;
            var energy = Vector.Dot(spin, momentum);
            for (var step = 1; step <= 3600; step++)
            {
                world.Step();
                if (step % 40 == 0)
                {
                    var time = step / 60.0;
                    var current = InertiaOf(body, inertia) * body.AngularVelocity;
                    Near.Equal(momentum, current, 1e-9 * momentum.Length());
                    Near.Equal(energy, Vector.Dot(body.AngularVelocity, current), 1e-9 * energy);
                    var expected = start + (time * velocity) + (0.5 * time * time * TestWorlds.Gravity);
                    Near.Equal(expected, body.Position, 1e-9 * (1 + expected.Length()));
                    Near.Equal(velocity + (time * TestWorlds.Gravity), body.Velocity, 1e-9 * velocity.Length());
                }
            }
        }
    }

    /// <summary>With as many substeps as there may be, it turns by three radians in each.</summary>
    [Fact]
    public void Flight_AtRadiansASubstep_KeepsEnergyAndAngularMomentum()
    {
        var mesh = MeshOf("plank");
        var inertia = SolidMoments.Of(mesh, AffineMap.Identity).Inertia;
        var spin = 2e5 * new Vector(3, -4, 5).UnitVector();
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        var body = world.Add(RigidMeshes.Describe(mesh, Vector.Zero) with { Mass = 1, AngularVelocity = spin });
        var momentum = inertia * spin;
        world.Run(2);
        var current = InertiaOf(body, inertia) * body.AngularVelocity;
        Near.Equal(momentum, current, 1e-8 * momentum.Length());
        Near.Equal(Vector.Dot(spin, momentum), Vector.Dot(body.AngularVelocity, current), 1e-8 * Vector.Dot(spin, momentum));
    }

    [Theory]
    [MemberData(nameof(Shapes))]
    public void Orientation_AfterTwoSeconds_IsThatOfEulersEquations(string name)
    {
        var mesh = MeshOf(name);
        var inertia = SolidMoments.Of(mesh, AffineMap.Identity).Inertia;
        foreach (var spin in new Vector[] { new(0.1, 10, 0), new(3, -4, 5), new(-6, 0.5, 7) })
        {
            var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
            var body = world.Add(RigidMeshes.Describe(mesh, Vector.Zero) with { AngularVelocity = spin });
            world.Run(120);
            var expected = new EulerIntegrator(inertia).Turn(spin, 2, 20_000);
            Near.Equal(expected.ToMatrix(), body.Orientation.ToMatrix(), 1e-5);
        }
    }

    [Fact]
    public void SymmetricTop_Precesses_AsTheClosedFormSays()
    {
        // The axis of a free top turns about the angular momentum at |L|/I across.
        var mesh = MeshOf("cone");
        var inertia = SolidMoments.Of(mesh, AffineMap.Identity).Inertia;
        var spin = new Vector(1, 9, 0);
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        var body = world.Add(RigidMeshes.Describe(mesh, Vector.Zero) with { AngularVelocity = spin });
        world.Run(120);
        var momentum = inertia * spin;
        var axis = Matrix.Rotation(momentum.UnitVector(), 2 * momentum.Length() / inertia.V1.X) * Vector.J;
        Near.Equal(axis, body.Orientation.Rotate(Vector.J), 1e-5);
    }

    [Fact]
    public void Points_OfAMirroredModel_AreWhereTheOrientationPutsThem()
    {
        var linear = Matrix.Rotation(Vector.K, 0.4) * Matrix.Diagonal(new(-1, 2, 0.5));
        var mesh = MeshOf("crooked");
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        var body = world.Add(RigidMeshes.Describe(mesh, new(4, 5, 6), linear) with { AngularVelocity = new(0, 0, 2) });
        var inertia = SolidMoments.Of(mesh, new AffineMap(linear, Vector.Zero)).Inertia;
        world.Run(60);
        var expected = new EulerIntegrator(inertia).Turn(new(0, 0, 2), 1, 10_000);
        Near.Equal(expected.ToMatrix(), body.Orientation.ToMatrix(), 1e-5);
        var centre = SolidMoments.Of(mesh, AffineMap.Identity).Centre;
        Near.Equal(new Vector(4, 5, 6), RigidMeshes.PointOf(body, centre), 1e-12);
    }

    /// <summary>A speed falls by e^(−rate·t), and so does a spin.</summary>
    [Fact]
    public void Flight_WithDamping_LosesSpeedAndSpinAlike()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), Vector.Zero) with
        {
            Damping = 0.7,
            Velocity = 2 * Vector.I,
            AngularVelocity = 3 * Vector.J,
        });
        world.Run(60);
        Near.Equal(2 * Math.Exp(-0.7) * Vector.I, body.Velocity, 1e-9);
        Near.Equal(3 * Math.Exp(-0.7) * Vector.J, body.AngularVelocity, 1e-9);
    }

    private static Matrix InertiaOf(Body body, Matrix inertia)
    {
        var rotation = body.Orientation.ToMatrix();
        return rotation * inertia * rotation.Transpose();
    }

    private static Mesh MeshOf(string name) => name switch
    {
        "box" => RigidMeshes.Box(1, 2, 3),
        "cone" => RigidMeshes.Revolve([(0, 0), (1, 0), (0, 2)], 16),
        "cylinder" => RigidMeshes.Revolve([(0, 0), (1, 0), (1, 0.5), (0, 0.5)], 12),
        "crooked" => RigidMeshes.Join(RigidMeshes.CreateL(), RigidMeshes.Box(new(0, 0, 1), new(0.5, 0.7, 2.5))),
        _ => RigidMeshes.Box(0.4, 2, 0.1),
    };
}
