using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using SharpGLTF.Schema2;
using Camera = FractalEngine.Core.Scenes.Cameras.Camera;
using Scene = FractalEngine.Core.Scenes.Scene;

namespace FractalEngine.Parsing.Gltf;

/// <summary>The camera and the lights of a glTF file, as a scene has them.</summary>
internal static class GltfSurroundings
{
    // Of our lights, intensities of 1 show a white surface white; of glTF's, those of π lux or candela.
    private const double White = Math.PI;

    /// <summary>Finds the first camera and all lights; null where there is none of either.</summary>
    /// <param name="nodes">The nodes. Those whose map has no inverse look and shine nowhere.</param>
    /// <param name="bounds">Bounds of all meshes, by which a light without a range has one so large that it does not show.</param>
    public static Scene? Find(List<(Node Node, AffineMap ToWorld)> nodes, BoundingBox bounds)
    {
        var usable = nodes.Where(static one => GltfNodes.HasInverse(one.ToWorld)).ToArray();
        var (seen, toWorld) = usable.FirstOrDefault(static one => one.Node.Camera is not null);
        Light[] lights = [.. usable.Where(static one => one.Node.PunctualLight is not null)
            .Select(one => ToLight(one.Node.PunctualLight, one.ToWorld, bounds))];
        return seen is null && lights.Length == 0 ? null : new()
        {
            Handedness = Handedness.Right,
            Camera = seen is null ? null : ToCamera(seen.Camera.Settings as CameraPerspective, toWorld),
            Projection = seen?.Camera.Settings is CameraOrthographic ? Projection.Orthographic : Projection.Perspective,
            OrthographicHeight = seen?.Camera.Settings is CameraOrthographic { YMag: not 0 and var half } ? 2 * Math.Abs(half) : null,
            Lights = [.. lights],
        };
    }

    /// <summary>Makes a camera, which looks along the −z of its node.</summary>
    private static Camera ToCamera(CameraPerspective? perspective, AffineMap toWorld)
    {
        var (right, up, back) = toWorld.Linear;
        var axes = new Matrix(Handedness.Right.Mirror(right), Handedness.Right.Mirror(up), Handedness.Right.Mirror(-back));
        return new(
            toWorld.Translation, axes.Orthonormalized().EulerAngles(),
            perspective is null ? Camera.Default.FieldOfView : Math.Clamp(perspective.VerticalFOV * 180 / Math.PI, 0.01, 179));
    }

    private static Light ToLight(PunctualLight light, AffineMap toWorld, BoundingBox bounds)
    {
        var linear = new Vector(light.Color.X, light.Color.Y, light.Color.Z);
        var strongest = linear.MaxAbsComponent() is > 0 and var found ? found : 1;
        var colour = new Colour(linear.X / strongest, linear.Y / strongest, linear.Z / strongest).FromLinear();
        var intensity = Math.Max(0, light.Intensity) * strongest / White;
        var (place, axis) = (toWorld.Translation, -toWorld.Linear.V3);
        if (light.LightType == PunctualLightType.Directional)
        {
            return new DirectionalLight(axis.UnitVector(), colour, intensity);
        }

        var range = light.Range is > 0 and < float.PositiveInfinity and var own ? own
            : 10 * ((bounds.IsEmpty ? 0 : (place - bounds.Centre).Length()) + bounds.FiniteDiagonalOr(1));
        // Ours have their intensity at a tenth of the range.
        intensity /= 0.01 * range * range;
        return light.LightType == PunctualLightType.Point ? new PointLight(place, colour, intensity, range) : new SpotLight(
            place, axis.UnitVector(), Math.Clamp(light.OuterConeAngle * 360 / Math.PI, 0.01, 179.99), colour, intensity, range);
    }
}
