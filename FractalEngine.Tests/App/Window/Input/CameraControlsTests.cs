using System.Globalization;
using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Input;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.App.Window.Input;

/// <summary>Tests that keys, mouse and wheel move a camera into a fractal to any depth, and out again.</summary>
public class CameraControlsTests
{
    private const double Aspect = 4.0 / 3;

    private static readonly TimeSpan Frame = TimeSpan.FromSeconds(1.0 / 60);
    private static readonly LodHierarchy Menger = LodHierarchy.Build(CullingViews.Menger(null));

    // The camera starts in front of this corner and looks at it.
    private static readonly Vector Corner = new(-1, 1, -1);
    private static readonly Vector StartPosition = new(-3, 3, -3.2);
    private static readonly Camera Start = new(StartPosition, CameraFraming.LookRotation(Corner - StartPosition), 50);

    private static Flight CreateFlight(Camera? camera = null, AffineMap? placement = null) =>
        Flight.Create(Menger, camera ?? Start, placement ?? AffineMap.Identity);

    /// <summary>Presses a key as the window does, which knows what actions it has.</summary>
    private static bool Press(CameraControls controls, Key key, KeyModifiers modifiers = KeyModifiers.None, bool isRepeat = false)
    {
        var pressed = new KeyPressed(key, modifiers, isRepeat);
        return controls.Handle(pressed, Aspect, ActionTable.Find(pressed)?.MoveCamera);
    }

    [Fact]
    public void Start_Outside_IsAtDepthZero()
    {
        var flight = CreateFlight();
        Assert.Equal((0, 0.0), (flight.Camera.Depth, flight.Camera.Log10Magnification));
        Near.Equal(Start.Position, flight.Camera.Camera.Position, 1e-12);
        var view = new View(flight.Camera.Camera, Projection.Perspective);
        Assert.Same(view, flight.Camera.WithDeepZoom(view));
    }

    [Fact]
    public void Start_Inside_IsWhereTheCameraIs() => Seeded.Run(100, random =>
    {
        var placement = random.Next(2) == 0 ? AffineMap.Identity : random.Transformation().ToAffineMap();
        var camera = new Camera(placement * random.Vector(1.3), random.Vector(), 40);
        var flight = CreateFlight(camera, placement);
        Near.Equal(camera.Position, flight.Camera.Camera.Position, 1e-12 * (1 + camera.Position.MaxAbsComponent()));
        Assert.Equal((camera.Rotation, camera.FieldOfView), (flight.Camera.Camera.Rotation, flight.Camera.Camera.FieldOfView));
    });

    [Theory]
    [InlineData(2, 1)]
    [InlineData(1, 1)]
    // The angle of view is that of the shorter side.
    [InlineData(0.5, 0.5)]
    public void Drag_WithTheMiddleButton_MovesBySoMuchOfTheShorterSide(double aspect, double expected)
    {
        Assert.Equal(expected, DistanceOf(aspect) / DistanceOf(1), 1e-9);

        static double DistanceOf(double aspect)
        {
            var flight = CreateFlight();
            flight.Controls.Handle(new MousePressed(MouseButton.Middle, 5, 5, KeyModifiers.None), aspect);
            Assert.True(flight.Controls.Handle(new MouseMoved(15, 5, 10, 0), aspect));
            return (flight.Camera.Camera.Position - StartPosition).Length();
        }
    }

    [Theory]
    [InlineData(100)]
    [InlineData(200)] // past the corner, which a direction in double precision misses
    public void Wheel_InAndOutAgain_IsOutside(int notches)
    {
        var flight = CreateFlight();
        var maxDepth = 0;
        for (var i = 0; i < notches; i++)
        {
            Assert.True(flight.Controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect));
            AssertFiniteAndNear(flight);
            maxDepth = Math.Max(maxDepth, flight.Camera.Depth);
        }

        Assert.True(maxDepth >= 20, Text($"only {maxDepth} levels"));
        Assert.True(
            flight.Camera.Log10Magnification >= 0.47 * flight.Camera.Depth,
            Text($"{flight.Camera.Log10Magnification} at depth {flight.Camera.Depth}"));
        for (var i = 0; i < notches; i++)
        {
            flight.Controls.Handle(new WheelTurned(-1, KeyModifiers.None), Aspect);
            AssertFiniteAndNear(flight);
        }

        Assert.Equal((0, 0.0), (flight.Camera.Depth, flight.Camera.Log10Magnification));
        // The camera is on its line of sight, about as far away as before.
        Assert.InRange((flight.Camera.Camera.Position - Corner).Length(), 0.3, 300);
    }

    [Fact]
    public void KeyW_Held_GoesDeeperAndSlowsDown()
    {
        var flight = CreateFlight();
        Press(flight.Controls, Key.W);
        var (last, far) = (flight.Camera.Camera.Position, 0.0);
        for (var i = 0; i < 60 * 30; i++)
        {
            flight.Controls.Advance(Frame);
            AssertFiniteAndNear(flight);
            var now = flight.Camera.Camera.Position;
            far = i < 60 ? Math.Max(far, (now - last).Length()) : far;
            last = now;
        }

        Assert.True(flight.Camera.Depth >= 5, Text($"only {flight.Camera.Depth} levels"));
        var before = flight.Camera.Camera.Position;
        flight.Controls.Advance(Frame);
        Assert.True((flight.Camera.Camera.Position - before).Length() < 0.01 * far);
        flight.Controls.Handle(new KeyReleased(Key.W, KeyModifiers.None), Aspect);
        Assert.False(flight.Controls.IsMoving);
        Assert.False(flight.Controls.Advance(Frame));
    }

    [Theory]
    [InlineData(KeyModifiers.Shift, 4)]
    [InlineData(KeyModifiers.Alt, 0.25)]
    public void KeyD_WithAModifier_IsAsFastAsThatSays(KeyModifiers modifier, double factor)
    {
        Near.Equal(factor, WayOf(modifier) / WayOf(KeyModifiers.None), 0.1 * factor); // it gets slower as it comes closer

        static double WayOf(KeyModifiers modifiers)
        {
            var flight = CreateFlight();
            Press(flight.Controls, Key.D, modifiers);
            var before = flight.Camera.Camera.Position;
            flight.Controls.Advance(Frame);
            return (flight.Camera.Camera.Position - before).Length();
        }
    }

    /// <summary>A flight of half a level is half of that of a whole one.</summary>
    [Fact]
    public void Zoom_OfHalfALevel_TakesHalfTheSteps()
    {
        var zoom = new CameraZoom(
            Menger.NodeAt(Menger.LevelCount).Box, new(0, Menger, AffineMap.Identity), new(Start, Projection.Perspective));
        Assert.Equal(0.5 * zoom.CountSteps(1), zoom.CountSteps(0.5));
    }

    [Fact]
    public void KeyS_AfterW_ComesOutAgain()
    {
        var flight = CreateFlight();
        Press(flight.Controls, Key.W);
        for (var i = 0; i < 60 * 20; i++)
        {
            flight.Controls.Advance(Frame);
        }

        Assert.True(flight.Camera.Depth > 2);
        flight.Controls.Handle(new KeyReleased(Key.W, KeyModifiers.None), Aspect);
        Press(flight.Controls, Key.S);
        for (var i = 0; i < 60 * 30; i++)
        {
            flight.Controls.Advance(Frame);
            AssertFiniteAndNear(flight);
        }

        Assert.Equal(0, flight.Camera.Depth);
        Assert.InRange(flight.Camera.Camera.Position.Length(), 2, 1000);
    }

    [Theory]
    [InlineData(Key.Enter)]
    [InlineData(Key.KeypadEnter)]
    public void Enter_FromDeep_ReturnsToTheStart(Key key)
    {
        var flight = CreateDeepFlight(150);
        Assert.True(flight.Camera.Depth > 5);
        Assert.True(Press(flight.Controls, key));
        Assert.Equal((0, 0.0), (flight.Camera.Depth, flight.Camera.Log10Magnification));
        Near.Equal(Start.Position, flight.Camera.Camera.Position, 1e-12);
        Assert.Equal(Start.Rotation, flight.Camera.Camera.Rotation);
        // The same input has the same effect as in the beginning.
        var fresh = CreateFlight();
        for (var i = 0; i < 30; i++)
        {
            flight.Controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
            fresh.Controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
        }

        Near.Equal(fresh.Camera.Camera.Position, flight.Camera.Camera.Position, 1e-12);
    }

    [Theory]
    [InlineData(Key.F)]
    [InlineData(Key.Digit1)]
    [InlineData(Key.Digit3)]
    [InlineData(Key.Digit7)]
    public void Framing_FromDeep_ShowsEverything(Key key)
    {
        var flight = CreateDeepFlight(150);
        Assert.True(Press(flight.Controls, key));
        Assert.Equal((0, 0.0), (flight.Camera.Depth, flight.Camera.Log10Magnification));
        var view = new View(flight.Camera.Camera, flight.Camera.Projection);
        for (var corner = 0; corner < 8; corner++)
        {
            var position = new Vector(SignOfBit(corner, 0), SignOfBit(corner, 1), SignOfBit(corner, 2));
            var (right, down, _) = view.Project(position, 400, 300)!.Value;
            Assert.InRange(right, 0, 400);
            Assert.InRange(down, 0, 300);
        }
    }

    [Fact]
    public void Orthographic_FromDeep_IsOfTheWholeSceneAndBack()
    {
        var flight = CreateDeepFlight(150);
        var (depth, position) = (flight.Camera.Depth, flight.Camera.Camera.Position);
        Assert.True(Press(flight.Controls, Key.Digit5));
        Assert.Equal(Projection.Orthographic, flight.Camera.Projection);
        var view = new View(flight.Camera.Camera, flight.Camera.Projection);
        Assert.Same(view, flight.Camera.WithDeepZoom(view));
        Near.Equal(position, flight.Camera.Camera.Position, 1e-12);
        AssertFiniteAndNear(flight);
        Press(flight.Controls, Key.Digit5);
        Assert.Equal(depth, flight.Camera.Depth);
        Assert.NotNull(flight.Camera.WithDeepZoom(new View(flight.Camera.Camera, flight.Camera.Projection)).DeepZoom);
    }

    [Fact]
    public void WithDeepZoom_Deep_HasRootsAndPlanesOfItsUnit()
    {
        const int NotchCount = 200;
        var flight = CreateFlight();
        var deepCount = 0;
        for (var notches = 0; notches < NotchCount; notches++)
        {
            flight.Controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
            var view = flight.Camera.WithDeepZoom(new View(flight.Camera.Camera, Projection.Perspective));
            if (flight.Camera.Depth == 0)
            {
                continue;
            }

            deepCount++;
            var (near, far) = view.FixedClipPlanes!.Value;
            Assert.True(0 < near && near < far && double.IsFinite(far), Text($"planes {near}, {far} at depth {flight.Camera.Depth}"));
            Assert.Equal(0, view.DeepZoom!.ObjectIndex);
            Near.Equal(-flight.Camera.Log10Magnification * Math.Log(10), view.DeepZoom.LogUnit, 1e-9);
            Assert.True(view.DeepZoom.Roots.Length >= 1 + (19 * Math.Min(20, flight.Camera.Depth)));
            Assert.All(view.DeepZoom.Roots, root => Assert.True(root.FrameToCamera.IsFinite()));
        }

        Seeded.AssertMost(deepCount, NotchCount);
    }

    [Fact]
    public void AnyInput_KeepsTheCameraFiniteAndNear() => Seeded.Run(25, random =>
    {
        var placement = random.Next(2) == 0 ? AffineMap.Identity : random.Transformation().ToAffineMap();
        var flight = CreateFlight(new Camera(random.Vector(1.5), random.Vector(), 50), placement);
        // The first ones move the camera as long as they are held.
        const int MovingKeyCount = 6;
        Key[] keys = [Key.W, Key.A, Key.S, Key.D, Key.Q, Key.E, Key.F, Key.Enter, Key.Digit1, Key.Digit3, Key.Digit5, Key.Digit7];
        for (var i = 0; i < 150; i++)
        {
            switch (random.Next(6))
            {
                case 0:
                    var key = keys[random.Next(random.Next(5) == 0 ? keys.Length : MovingKeyCount)];
                    Press(flight.Controls, key, (KeyModifiers)random.Next(8), random.Next(3) == 0);
                    break;
                case 1:
                    flight.Controls.Handle(new KeyReleased(keys[random.Next(MovingKeyCount)], KeyModifiers.None), Aspect);
                    break;
                case 2:
                    flight.Controls.Handle(new WheelTurned(random.Between(-3, 8), KeyModifiers.None), Aspect);
                    break;
                case 3:
                    flight.Controls.Handle(new MousePressed((MouseButton)random.Next(3), 0, 0, (KeyModifiers)random.Next(4)), Aspect);
                    flight.Controls.Handle(new MouseMoved(0, 0, random.Between(-200, 200), random.Between(-200, 200)), Aspect);
                    break;
                case 4:
                    flight.Controls.Handle(new FocusLost(), Aspect);
                    break;
                default:
                    for (var frame = 0; frame < 5; frame++)
                    {
                        flight.Controls.Advance(random.Next(2) * Frame);
                    }

                    break;
            }

            AssertFiniteAndNear(flight, 1e9);
        }
    });

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Wheel_AwayFromTheMiddle_KeepsWhatIsUnderThePointer(Projection projection) => Seeded.Run(50, random =>
    {
        var camera = new FlyingCamera(new(-Vector.One, Vector.One), Start, projection, projection == Projection.Perspective ? null : 4);
        var controls = new CameraControls(camera) { Viewport = (10, 20, 400, 300) };
        var (x, y) = (random.Between(10, 410), random.Between(20, 320));
        // The point under the pointer, at the depth of the focus.
        var halfHeight = projection == Projection.Orthographic ? 2 : camera.FocusDistance * Start.HalfHeightAtUnitDepth;
        var offset = new Vector((x - 210) / 150 * halfHeight, (170 - y) / 150 * halfHeight, camera.FocusDistance);
        var point = Start.Position + (Start.LocalAxes * offset);
        controls.Handle(new MouseMoved(x, y, 0, 0), Aspect);
        controls.Handle(new WheelTurned(random.Between(-5, 5), KeyModifiers.None), Aspect);
        var view = new View(camera.Camera, projection) { OrthographicHeight = camera.OrthographicHeight ?? 1 };
        var (right, down, _) = view.Project(point, 400, 300)!.Value;
        Near.Equal(new Vector(x - 10, y - 20, 0), new(right, down, 0), 1e-6);
    });

    [Fact]
    public void Key5_KeepsTheSizeOfWhatIsInFocus()
    {
        var camera = new FlyingCamera(new(-Vector.One, Vector.One), Start, Projection.Perspective, null);
        var controls = new CameraControls(camera);
        controls.Handle(new WheelTurned(3, KeyModifiers.None), Aspect);
        var before = camera.Camera;
        var focus = before.Position + (camera.FocusDistance * before.LocalAxes.V3) + (0.3 * before.LocalAxes.V1);
        var size = new View(before, Projection.Perspective).Project(focus, 400, 300)!.Value.X;
        Press(controls, Key.Digit5);
        var view = new View(camera.Camera, Projection.Orthographic) { OrthographicHeight = camera.OrthographicHeight!.Value };
        Near.Equal(size, view.Project(focus, 400, 300)!.Value.X, 1e-9);
        Press(controls, Key.Digit5);
        Assert.Equal(before, camera.Camera);
        // The size stays also after zooming in between.
        Press(controls, Key.Digit5);
        controls.Handle(new WheelTurned(2, KeyModifiers.None), Aspect);
        view = new View(camera.Camera, Projection.Orthographic) { OrthographicHeight = camera.OrthographicHeight!.Value };
        size = view.Project(focus, 400, 300)!.Value.X;
        Press(controls, Key.Digit5);
        Near.Equal(size, new View(camera.Camera, Projection.Perspective).Project(focus, 400, 300)!.Value.X, 1e-9);
    }

    [Fact]
    public void Restore_FromDeep_ReturnsToTheSamePlaceInTheFractal()
    {
        var flight = CreateDeepFlight(150);
        var state = flight.Camera.State;
        var (depth, magnification) = (flight.Camera.Depth, flight.Camera.Log10Magnification);
        Press(flight.Controls, Key.Enter);
        flight.Camera.Restore(state);
        Assert.Equal((depth, magnification), (flight.Camera.Depth, flight.Camera.Log10Magnification));
        Assert.Equal(state, flight.Camera.State);
        // The state itself does not move with the camera.
        flight.Controls.Handle(new WheelTurned(50, KeyModifiers.None), Aspect);
        flight.Camera.Restore(state);
        Assert.Equal((depth, magnification), (flight.Camera.Depth, flight.Camera.Log10Magnification));
    }

    [Fact]
    public void KeyW_TowardsACorner_IsAsFastAsItsDistance()
    {
        var hierarchy = LodHierarchy.Build(FractalAddressTests.CreateInfinite("sierpinski"));
        var camera = new Camera(new(-1, -1, -1), CameraFraming.LookRotation(Vector.One), 50);
        var flight = Flight.Create(hierarchy, camera, AffineMap.Identity);
        Press(flight.Controls, Key.W);
        var left = flight.Camera.Camera.Position.Length();
        for (var i = 0; i < 600; i++)
        {
            flight.Controls.Advance(Frame);
            var now = flight.Camera.Camera.Position.Length();
            // A frame of 1/60 s covers 0.8/60 of the distance, which is known to a tenth.
            Assert.InRange((left - now) / left, -1e-9, 1.15 * 0.8 / 60);
            left = now;
        }

        Assert.True(flight.Camera.Depth >= 3, Text($"depth {flight.Camera.Depth}"));
    }

    private static Flight CreateDeepFlight(int notches)
    {
        var flight = CreateFlight();
        for (var i = 0; i < notches; i++)
        {
            flight.Controls.Handle(new WheelTurned(1, KeyModifiers.None), Aspect);
        }

        return flight;
    }

    private static void AssertFiniteAndNear(Flight flight, double maxDistance = 1000)
    {
        var depth = flight.Camera.Depth;
        var magnification = flight.Camera.Log10Magnification;
        var camera = flight.Camera.Camera;
        Assert.True(
            camera.Position.IsFinite() && camera.Rotation.IsFinite() && double.IsFinite(magnification)
            && camera.Position.Length() < maxDistance,
            Text($"at depth {depth}, {magnification}: {camera.Position}, {camera.Rotation}"));
        if (depth > 0)
        {
            Assert.True(camera.Position.Length() < Math.Max(10, 1e-6 * maxDistance), Text($"{camera.Position} at depth {depth}"));
        }
    }

    private static double SignOfBit(int number, int bit) => ((number >> bit) & 1) == 0 ? -1 : 1;

    private static string Text(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);

    /// <summary>A camera in front of a fractal, with its controls.</summary>
    private sealed record Flight(FlyingCamera Camera, CameraControls Controls)
    {
        public static Flight Create(LodHierarchy hierarchy, Camera start, AffineMap placement)
        {
            var bounds = hierarchy.NodeAt(hierarchy.LevelCount).Box.Transform(placement);
            var camera = new FlyingCamera(bounds, start, Projection.Perspective, null, new(0, hierarchy, placement));
            return new(camera, new(camera));
        }
    }
}
