// Bends normals by an image of normals or heights, as Render.Tracing.SurfaceDetail does. Behind material.glsl and lighting.glsl.

uniform sampler2D detailTexture;

in vec2 pixelDetail;

vec3 detailAt(vec2 coordinates)
{
    vec2 scaled = coordinates * material[7].xy + material[7].zw;
    return texture(detailTexture, vec2(scaled.x, 1.0 - scaled.y)).rgb;
}

// What the position changes by when a texture coordinate grows by 1 follows from their changes from pixel to pixel.
vec3 bend(vec3 n, vec3 position, vec3 toEye)
{
    vec3 p1 = dFdx(position);
    vec3 p2 = dFdy(position);
    vec2 t1 = dFdx(pixelDetail);
    vec2 t2 = dFdy(pixelDetail);
    vec3 here = detailAt(pixelDetail);
    vec2 texel = 1.0 / (vec2(textureSize(detailTexture, 0)) * abs(material[7].xy));
    vec2 beside = vec2(detailAt(pixelDetail + vec2(texel.x, 0.0)).r, detailAt(pixelDetail + vec2(0.0, texel.y)).r);
    float determinant = t1.x * t2.y - t1.y * t2.x;
    if (determinant == 0.0)
    {
        return n;
    }

    vec3 alongU = (t2.y * p1 - t1.y * p2) / determinant;
    vec3 alongV = (t1.x * p2 - t2.x * p1) / determinant;
    alongU -= dot(alongU, n) * n;
    alongV -= dot(alongV, n) * n;
    vec3 bent = n;
    if (material[6].w == 0.0)
    {
        vec3 stored = 2.0 * here - 1.0;
        bent = stored.x * direction(alongU) + stored.y * direction(alongV) + max(stored.z, 0.0) * n;
    }
    else
    {
        float unit = sqrt(length(alongU) * length(alongV));
        vec2 slopes = unit * material[6].w * (beside - here.r) / texel;
        vec3 gradient = slopes.x * cross(alongV, n) + slopes.y * cross(n, alongU);
        bent = n - gradient / dot(n, cross(alongU, alongV));
    }

    bent = direction(bent);
    return dot(bent, toEye) > 0.0 ? bent : n;
}
