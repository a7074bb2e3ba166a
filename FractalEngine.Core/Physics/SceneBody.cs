using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>How bodies come from the objects of a scene, and objects from bodies.</summary>
internal static class SceneBody
{
    /// <summary>Describes the body of a physics object.</summary>
    /// <exception cref="SceneObjectException">No body can be made of it.</exception>
    public static BodyDescription Describe(PlacedModel placed, PhysicsObject declared, int index)
    {
        BodyDescription description;
        try
        {
            description = BodyDescription.FromPhysicsObject(placed, declared, index);
        }
        catch (FractalLimitException exception)
        {
            throw new SceneObjectException(index, exception.Kind, $"body {declared.DisplayName}: {exception.Message}", exception);
        }
        catch (ArgumentException exception)
        {
            throw new SceneObjectException(index, ErrorKind.Input, $"body {declared.DisplayName}: {exception.Message}", exception);
        }

        if (description.FindFault() is { } fault)
        {
            // A body grows beyond all numbers where its fractal does.
            var kind = double.IsFinite(description.Radius) ? ErrorKind.Input : ErrorKind.Limit;
            throw new SceneObjectException(index, kind, $"body {declared.DisplayName}: {fault}");
        }

        return description;
    }

    /// <summary>The object of a body where that is between its last two states.</summary>
    /// <param name="body">The body.</param>
    /// <param name="original">Its object in the scene.</param>
    /// <param name="alpha">Fraction of the last step that has passed, from 0 to 1.</param>
    public static PlacedModel PlaceAt(Body body, PlacedModel original, double alpha)
    {
        var placement = original.Declaration.Placement;
        var isAsItStands = alpha == 1 && body.Description.ObjectOffset == Vector.Zero;
        var scale = alpha == 1 ? body.Scale : body.PreviousScale + (alpha * (body.Scale - body.PreviousScale));
        var orientation = alpha == 1 ? body.Orientation : Orientation.Interpolate(body.PreviousOrientation, body.Orientation, alpha);
        placement = placement with
        {
            Position = isAsItStands ? body.Position : body.InterpolatedMap(alpha).Translation,
            Scale = scale * placement.Scale,
        };
        placement = orientation == Orientation.Identity ? placement : orientation.Turn(placement);
        return new(original.Declaration with { Placement = placement }, original.Model);
    }
}
