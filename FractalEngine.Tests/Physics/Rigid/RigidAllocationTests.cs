using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Steps of bodies of meshes allocate nothing once all parts have been visited that they touch with.</summary>
[Collection(AloneTests.Name)]
public class RigidAllocationTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void Steps_OfCratesThatSlide_AllocateNothing(int threads) => Assert.Equal(0, Allocation.MeasureAllThreads(30, () =>
    {
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = threads, SleepSpeed = 0 });
        world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, new(80, 1, 80)));
        for (var i = 0; i < 12; i++)
        {
            world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(3 * (i % 4), 0.5001 + (i / 4), 0)) with { Velocity = Vector.K });
        }

        world.Run(60);
        return _ => world.Step();
    }));
}
