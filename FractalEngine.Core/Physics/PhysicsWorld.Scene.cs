using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <content>How bodies come from a scene, and a scene from bodies.</content>
public sealed partial class PhysicsWorld
{
    /// <summary>The world's scene with all objects where they are now, followed by the static objects that were added.</summary>
    /// <param name="alpha">Fraction of the last step that has passed, from 0 to 1: frames between two steps show what lies between.</param>
    /// <remarks>Bodies that were added have no model and are not part of it.</remarks>
    public LoadedScene GetCurrentScene(double alpha = 1)
    {
        var objects = _scene.Objects.ToBuilder();
        foreach (var body in _bodies)
        {
            if (body.Description.ObjectIndex is { } index)
            {
                var original = _scene.Objects[index];
                var placement = original.Declaration.Placement;
                var scale = alpha == 1 ? body.Scale : body.PreviousScale + (alpha * (body.Scale - body.PreviousScale));
                var isAsItStands = alpha == 1 && body.Description.ObjectOffset == Vector.Zero;
                var position = isAsItStands ? body.Position : body.InterpolatedMap(alpha).Translation;
                var orientation =
                    alpha == 1 ? body.Orientation : Orientation.Interpolate(body.PreviousOrientation, body.Orientation, alpha);
                placement = placement with { Position = position, Scale = scale * placement.Scale };
                if (orientation != Orientation.Identity)
                {
                    var axes = orientation.ToMatrix() * placement.Rotation.LocalAxesFromDegrees();
                    placement = placement with { Rotation = 180 / Math.PI * axes.EulerAngles() };
                }

                objects[index] = new(original.Declaration with { Placement = placement }, original.Model);
            }
        }

        foreach (var placed in _statics.Objects)
        {
            var present = alpha == 1 ? placed.Placed : placed.PlaceAt(alpha);
            if (placed.ObjectIndex is { } index)
            {
                objects[index] = present;
            }
            else
            {
                objects.Add(present);
            }
        }

        var scene = _scene.Scene with { Gravity = _gravity, Objects = [.. objects.Select(static placed => placed.Declaration)] };
        return new(scene, objects.ToImmutable());
    }

    /// <summary>Describes the body of a physics object.</summary>
    /// <exception cref="SceneObjectException">No body can be made of it.</exception>
    private static BodyDescription DescribeBody(PlacedModel placed, PhysicsObject declared, int index)
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
}
