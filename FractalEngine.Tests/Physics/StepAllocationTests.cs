using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>The first steps of small worlds allocate nothing on any thread, see <see cref="AllocationTests"/> for long runs.</summary>
[Collection(AloneTests.Name)]
public class StepAllocationTests
{
    [Fact]
    public void Steps_OfBodiesOfManyLayers_AllocateNothing() => Check(20, CreateLayers);

    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void Steps_OfADenseHeap_AllocateNothing(int threads) => Check(4, () => CreateHeap(threads));

    private static void Check(int steps, Func<PhysicsWorld> create) => Assert.Equal(0, Allocation.MeasureAllThreads(steps, () =>
    {
        var world = create();
        world.BuildColliders();
        foreach (var target in world.StaticObjects)
        {
            // An object takes some memory at the first query that reaches it.
            world.TryFindClosest(target.Bounds.Centre, ColliderKind.Exact, out _);
        }

        return _ => world.Step();
    }));

    /// <summary>So dense that each ball touches its six neighbours, at once.</summary>
    private static PhysicsWorld CreateHeap(int threads)
    {
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = threads });
        world.AddStatic(PhysicsMeshes.FloorMesh());
        world.AddRange(Enumerable.Range(0, 343).Select(static i => new BodyDescription(
            new Vector(i % 7, 0.5 + (i / 49), i / 7 % 7), 0.5)));
        return world;
    }

    private static PhysicsWorld CreateLayers()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true });
        world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, new(20, 1, 20)));
        world.AddStatic(PhysicsMeshes.Cube, Transformation.At(new Vector(0, 2, 0))).Layer = 3;
        world.AddRange(Enumerable.Range(0, 30).Select(static i => new BodyDescription(new(0.7 * (i % 5), 0.8 + (0.9 * (i / 5)), 0), 0.4)
        {
            Layer = i % 3, Mask = i % 2 == 0 ? Layers.All : ~8u, Friction = 0.3,
        }));
        return world;
    }
}
