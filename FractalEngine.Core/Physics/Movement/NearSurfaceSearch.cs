using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>Finds faces that a ball touches or may meet, from several places near it: one query knows only the closest.</summary>
internal sealed class NearSurfaceSearch(Obstacles obstacles)
{
    // Relative to the radius.
    private const double MaxLift = 0.5;

    // Cosine of an angle that rounding cannot tell from 0.
    private const double SameDirection = 1 - 1e-12;

    // In a corner a ball has three faces.
    private const int MaxQueries = 3;

    /// <summary>Finds the faces near a ball, for which the obstacles must be set up.</summary>
    /// <param name="centre">Centre of the ball, world space.</param>
    /// <param name="maxTravel">How far it may move.</param>
    /// <param name="contacts">What it touches.</param>
    /// <param name="surfaces">Receives the faces.</param>
    /// <param name="closest">The closest surface, if there is one.</param>
    /// <returns>False where no surface is near.</returns>
    public bool TryFind(Vector centre, double maxTravel, ContactSet contacts, NearSurfaceList surfaces, out Contact closest)
    {
        if (!obstacles.TryFindNearSurface(centre, maxTravel, out closest))
        {
            return false;
        }

        var surface = closest;
        var lift = surface.Normal(centre);
        if (surface.IsFlat || surface.Gap(centre) < ContactTolerances.SurfaceMargin * obstacles.Radius)
        {
            surfaces.Add(in surface, lift, contacts, centre);
        }

        // From somewhat farther off all that is known, the next surface is the closest one. No surface is within half a radius of there.
        var height = Math.Min(maxTravel, MaxLift * obstacles.Radius);
        for (var i = 1; i < MaxQueries && surface.IsFlat; i++)
        {
            if (!obstacles.TryFindFace(centre + (height * lift), centre, height, out surface, out var normal))
            {
                break;
            }

            surfaces.Add(in surface, normal, contacts, centre);
            if (Vector.Dot(lift, normal) > SameDirection)
            {
                // The next search would be the same one.
                break;
            }

            lift = (lift + normal).UnitVectorOrZero();
        }

        return true;
    }
}
