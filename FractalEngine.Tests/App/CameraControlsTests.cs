using System.Globalization;
using FractalEngine.App.Window;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility;

namespace FractalEngine.Tests.App;

/// <summary>A camera that keys and wheel move in a fractal, as deep as one likes.</summary>
public class CameraControlsTests
{
    private const double Aspect = 4.0 / 3;

    private static readonly TimeSpan Frame = TimeSpan.FromSeconds(1.0 / 60);
    private static readonly LodHierarchy Menger = LodHierarchy.Build(CullingViews.Menger(null));

    // Before a corner, looking at it.
    private static readonly Vector Corner = new(-1, 1, -1);
    private static readonly Vector StartPosition = new(-3, 3, -3.2);
    private static readonly Camera Start = new(StartPosition, CameraFraming.LookRotation(Corner - StartPosition), 50);

    private static CameraControls CreateControls(Camera? camera = null, AffineMap? placement = null) =>
        (placement ?? AffineMap.Identity) switch
    {
        var objectToWorld =>
            new(Menger.NodeAt(Menger.LevelCount).Box.Transform(objectToWorld), camera ?? Start, Projection.Perspective, null,
            new(0, Menger, objectToWorld)),
    };

    private static KeyPressed KeyPress(Key key) => new(key, KeyModifiers.None, false);

    [Fact]
    public void Start_Outside_IsAtDepthZero()
    {
        var controls = CreateControls();
        Assert.Equal((0, 0.0), (controls.Depth, controls.Log10Magnification));
        Near.Equal(Start.Position, controls.Camera.Position, 1e-12);
        var view = new View(controls.Camera, Projection.Perspective);
        Assert.Same(view, controls.WithDeepZoom(view));
    }

    [Fact]
    public void Start_Inside_IsWhereTheCameraIs() => Seeded.Run(100, random =>
    {
        var placement = random.Next(2) == 0 ? AffineMap.Identity : random.Transformation().ToAffineMap();
        var camera = new Camera(placement * random.Vector(1.3), random.Vector(), 40);
        var controls = CreateControls(camera, placement);
        Near.Equal(camera.Position, controls.Camera.Position, 1e-12 * (1 + camera.Position.MaxAbsComponent()));
        Assert.Equal((camera.Rotation, camera.FieldOfView), (controls.Camera.Rotation, controls.Camera.FieldOfView));
    });

    [Theory]
    [InlineData(100)]
    [InlineData(200)] // past the corner, as a direction of double precision misses it
    public void Wheel_InAndOutAgain_IsOutside(int notches)
    {
        var controls = CreateControls();
        var maxDepth = 0;
        for (var i = 0; i < notches; i++)
        {
            Assert.True(controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect));
            AssertFiniteAndNear(controls);
            maxDepth = Math.Max(maxDepth, controls.Depth);
        }

        Assert.True(maxDepth >= 20, Text($"only {maxDepth} levels"));
        Assert.True(controls.Log10Magnification >= 0.47 * controls.Depth, Text($"{controls.Log10Magnification} at depth {controls.Depth}"));
        for (var i = 0; i < notches; i++)
        {
            controls.Handle(new WheelTurned(-1, KeyModifiers.None), Aspect);
            AssertFiniteAndNear(controls);
        }

        Assert.Equal((0, 0.0), (controls.Depth, controls.Log10Magnification));
        // On the line of sight, about as far away as before.
        Assert.InRange((controls.Camera.Position - Corner).Length(), 0.3, 300);
    }

    [Fact]
    public void KeyW_Held_GoesDeeperAndSlowsDown()
    {
        var controls = CreateControls();
        controls.Handle(KeyPress(Key.W), Aspect);
        var (last, far) = (controls.Camera.Position, 0.0);
        for (var i = 0; i < 60 * 30; i++)
        {
            controls.Advance(Frame);
            AssertFiniteAndNear(controls);
            var now = controls.Camera.Position;
            far = i < 60 ? Math.Max(far, (now - last).Length()) : far;
            last = now;
        }

        Assert.True(controls.Depth >= 5, Text($"only {controls.Depth} levels"));
        var before = controls.Camera.Position;
        controls.Advance(Frame);
        Assert.True((controls.Camera.Position - before).Length() < 0.01 * far);
        // The nearest surface is always farther than one picture's step.
        controls.Handle(new KeyReleased(Key.W, KeyModifiers.None), Aspect);
        Assert.False(controls.IsMoving);
        Assert.False(controls.Advance(Frame));
    }

    [Fact]
    public void KeyS_AfterW_ComesOutAgain()
    {
        var controls = CreateControls();
        controls.Handle(KeyPress(Key.W), Aspect);
        for (var i = 0; i < 60 * 20; i++)
        {
            controls.Advance(Frame);
        }

        Assert.True(controls.Depth > 2);
        controls.Handle(new KeyReleased(Key.W, KeyModifiers.None), Aspect);
        controls.Handle(KeyPress(Key.S), Aspect);
        for (var i = 0; i < 60 * 30; i++)
        {
            controls.Advance(Frame);
            AssertFiniteAndNear(controls);
        }

        Assert.Equal(0, controls.Depth);
        Assert.InRange(controls.Camera.Position.Length(), 2, 1000);
    }

    [Theory]
    [InlineData(Key.Enter)]
    [InlineData(Key.KeypadEnter)]
    public void Enter_FromDeep_ReturnsToTheStart(Key key)
    {
        var controls = CreateDeepControls(150);
        Assert.True(controls.Depth > 5);
        Assert.True(controls.Handle(KeyPress(key), Aspect));
        Assert.Equal((0, 0.0), (controls.Depth, controls.Log10Magnification));
        Near.Equal(Start.Position, controls.Camera.Position, 1e-12);
        Assert.Equal(Start.Rotation, controls.Camera.Rotation);
        // Everything after that is as at the beginning.
        var fresh = CreateControls();
        for (var i = 0; i < 30; i++)
        {
            controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
            fresh.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
        }

        Near.Equal(fresh.Camera.Position, controls.Camera.Position, 1e-12);
    }

    [Theory]
    [InlineData(Key.F)]
    [InlineData(Key.Digit1)]
    [InlineData(Key.Digit3)]
    [InlineData(Key.Digit7)]
    public void Framing_FromDeep_ShowsEverything(Key key)
    {
        var controls = CreateDeepControls(150);
        Assert.True(controls.Handle(KeyPress(key), Aspect));
        Assert.Equal((0, 0.0), (controls.Depth, controls.Log10Magnification));
        var view = new View(controls.Camera, controls.Projection);
        foreach (var corner in from x in (double[])[-1, 1] from y in (double[])[-1, 1] from z in (double[])[-1, 1] select new Vector(x, y,
            z))
        {
            var (right, down, _) = view.Project(corner, 400, 300)!.Value;
            Assert.InRange(right, 0, 400);
            Assert.InRange(down, 0, 300);
        }
    }

    [Fact]
    public void Orthographic_FromDeep_IsOfTheWholeSceneAndBack()
    {
        var controls = CreateDeepControls(150);
        var (depth, position) = (controls.Depth, controls.Camera.Position);
        Assert.True(controls.Handle(KeyPress(Key.Digit5), Aspect));
        Assert.Equal(Projection.Orthographic, controls.Projection);
        var view = new View(controls.Camera, controls.Projection);
        Assert.Same(view, controls.WithDeepZoom(view));
        Near.Equal(position, controls.Camera.Position, 1e-12);
        AssertFiniteAndNear(controls);
        controls.Handle(KeyPress(Key.Digit5), Aspect);
        Assert.Equal(depth, controls.Depth);
        Assert.NotNull(controls.WithDeepZoom(new View(controls.Camera, controls.Projection)).DeepZoom);
    }

    [Fact]
    public void WithDeepZoom_Deep_HasRootsAndPlanesOfItsUnit()
    {
        var controls = CreateControls();
        for (var notches = 0; notches < 200; notches++)
        {
            controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
            var view = controls.WithDeepZoom(new View(controls.Camera, Projection.Perspective));
            if (controls.Depth == 0)
            {
                continue;
            }

            var (near, far) = view.Clip!.Value;
            Assert.True(0 < near && near < far && double.IsFinite(far), Text($"planes {near}, {far} at depth {controls.Depth}"));
            Assert.Equal(0, view.DeepZoom!.ObjectIndex);
            Near.Equal(-controls.Log10Magnification * Math.Log(10), view.DeepZoom.LogUnit, 1e-9);
            Assert.True(view.DeepZoom.Roots.Length >= 1 + (19 * Math.Min(20, controls.Depth)));
            Assert.All(view.DeepZoom.Roots, root => Assert.True(root.FrameToCamera.IsFinite()));
        }
    }

    [Fact]
    public void AnyInput_KeepsTheCameraFiniteAndNear() => Seeded.Run(25, random =>
    {
        var controls = CreateControls(new Camera(random.Vector(1.5), random.Vector(), 50), random.Next(2) == 0
            ? AffineMap.Identity
            : random.Transformation().ToAffineMap());
        Key[] keys = [Key.W, Key.A, Key.S, Key.D, Key.Q, Key.E, Key.F, Key.Enter, Key.Digit1, Key.Digit3, Key.Digit5, Key.Digit7];
        for (var i = 0; i < 150; i++)
        {
            switch (random.Next(6))
            {
                case 0:
                    controls.Handle(new KeyPressed(keys[random.Next(random.Next(5) == 0 ? keys.Length : 6)], (KeyModifiers)random.Next(8),
                        random.Next(3) == 0), Aspect);
                    break;
                case 1:
                    controls.Handle(new KeyReleased(keys[random.Next(6)], KeyModifiers.None), Aspect);
                    break;
                case 2:
                    controls.Handle(new WheelTurned(random.Between(-3, 8), KeyModifiers.None), Aspect);
                    break;
                case 3:
                    controls.Handle(new MousePressed((MouseButton)random.Next(3), 0, 0, (KeyModifiers)random.Next(4)), Aspect);
                    controls.Handle(new MouseMoved(0, 0, random.Between(-200, 200), random.Between(-200, 200)), Aspect);
                    break;
                case 4:
                    controls.Handle(new FocusLost(), Aspect);
                    break;
                default:
                    for (var frame = 0; frame < 5; frame++)
                    {
                        controls.Advance(random.Next(2) * Frame);
                    }

                    break;
            }

            AssertFiniteAndNear(controls, 1e9);
        }
    });

    [Fact]
    public void KeyW_TowardsACorner_IsAsFastAsItIsFarAway()
    {
        var hierarchy = LodHierarchy.Build(FractalAddressTests.CreateInfinite("sierpinski"));
        var camera = new Camera(new(-1, -1, -1), CameraFraming.LookRotation(Vector.One), 50);
        var controls = new CameraControls(hierarchy.NodeAt(hierarchy.LevelCount).Box, camera, Projection.Perspective, null,
            new(0, hierarchy, AffineMap.Identity));
        controls.Handle(KeyPress(Key.W), Aspect);
        var left = controls.Camera.Position.Length();
        for (var i = 0; i < 600; i++)
        {
            controls.Advance(Frame);
            var now = controls.Camera.Position.Length();
            // A frame of a sixtieth of a second takes 0.8/60 of the distance, which is known to a tenth.
            Assert.InRange((left - now) / left, -1e-9, 1.15 * 0.8 / 60);
            left = now;
        }

        Assert.True(controls.Depth >= 3, Text($"depth {controls.Depth}"));
    }

    private static CameraControls CreateDeepControls(int notches)
    {
        var controls = CreateControls();
        for (var i = 0; i < notches; i++)
        {
            controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
        }

        return controls;
    }

    private static void AssertFiniteAndNear(CameraControls controls, double maxDistance = 1000)
    {
        var camera = controls.Camera;
        Assert.True(
            camera.Position.IsFinite() && camera.Rotation.IsFinite() && double.IsFinite(controls.Log10Magnification)
            && camera.Position.Length() < maxDistance,
            Text($"at depth {controls.Depth}, {controls.Log10Magnification}: {camera.Position}, {camera.Rotation}"));
        if (controls.Depth > 0)
        {
            Assert.True(camera.Position.Length() < Math.Max(10, 1e-6 * maxDistance), Text($"{camera.Position} at depth {controls.Depth}"));
        }
    }

    private static string Text(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);
}
