using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Tests.Render;

/// <summary>Integrals over the surface of a lamp as a point sees it, cell by cell of the surface itself.</summary>
internal static class LampIntegral
{
    /// <summary>The radiance of a lamp: π times the intensity falls onto what is a tenth of the range away.</summary>
    public static double RadianceOf(PointLight light) => Math.PI * light.Intensity * Math.Pow(light.Range / 10, 2) / (light switch
    {
        QuadLight quad => quad.Width * quad.Height,
        BallLight ball => Math.PI * ball.Radius * ball.Radius,
        _ => double.NaN,
    });

    /// <summary>Integrates a function of the direction over the solid angle of a lamp.</summary>
    public static Vector Over(PointLight light, Vector point, Func<Vector, Vector> function, int steps = 200)
    {
        var sum = Vector.Zero;
        for (var i = 0; i < steps; i++)
        {
            for (var j = 0; j < steps; j++)
            {
                var (place, normal, area) = light is QuadLight quad
                    ? Cell(quad, (i + 0.5) / steps, (j + 0.5) / steps)
                    : Cell((BallLight)light, point, (i + 0.5) / steps, (j + 0.5) / steps);
                var toLight = place - point;
                var distance = toLight.Length();
                toLight /= distance;
                var facing = -Vector.Dot(normal, toLight);
                sum += facing > 0 ? area / (steps * steps) * facing / (distance * distance) * function(toLight) : Vector.Zero;
            }
        }

        return sum;
    }

    /// <summary>The irradiance of a face divided by π, by a lamp whose range is far away.</summary>
    public static double Irradiance(PointLight light, Vector point, Vector normal, int steps = 200) =>
        RadianceOf(light) / Math.PI * Over(light, point, toLight => Math.Max(0, Vector.Dot(normal, toLight)) * Vector.One, steps).X;

    private static (Vector Place, Vector Normal, double Area) Cell(QuadLight light, double u, double v)
    {
        var normal = light.Direction.UnitVector();
        var level = new Vector(normal.Z, 0, -normal.X);
        level = level.Length() > 0 ? level.UnitVector() : Vector.I;
        var up = Vector.Cross(normal, level);
        var (sine, cosine) = Math.SinCos(light.Turn * Math.PI / 180);
        var width = (cosine * level) + (sine * up);
        return (
            light.Position + ((u - 0.5) * light.Width * width) + ((v - 0.5) * light.Height * Vector.Cross(normal, width)), normal,
            light.Width * light.Height);
    }

    // Of the cap that the point sees.
    private static (Vector Place, Vector Normal, double Area) Cell(BallLight light, Vector point, double u, double v)
    {
        var toPoint = point - light.Position;
        var axis = toPoint.UnitVector();
        var across = Vector.Cross(axis, Math.Abs(axis.X) < 0.5 ? Vector.I : Vector.J).UnitVector();
        var (sine, cosine) = Math.SinCos(2 * Math.PI * v);
        var rim = light.Radius / toPoint.Length();
        var height = rim + (u * (1 - rim));
        var normal = (height * axis)
            + (Math.Sqrt(1 - (height * height)) * ((cosine * across) + (sine * Vector.Cross(axis, across))));
        return (light.Position + (light.Radius * normal), normal, 2 * Math.PI * light.Radius * light.Radius * (1 - rim));
    }
}
